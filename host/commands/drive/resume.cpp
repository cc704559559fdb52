#include <memory>

#include "host/commands/drive/ask_driven.hpp"
#include "host/commands/drive/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/robot/motion/rest.hpp"

namespace astro::commands {

void add_resume(console::Command app) {
  const auto options = std::make_shared<ConnectionOptions>();
  const console::Command command = app.add_subcommand("resume", "let a paused robot go on");
  add_connection(command, *options);
  console::examples(command, {"astrolabe resume"});
  command.callback([options] {
    const auto client = connect(*options);
    const bool paused = client->request(protocol::GetStatus{}).mode == protocol::Mode::paused;
    ask_driven(
        *client, protocol::Resume{},
        "there is nothing to resume: the drive was stopped or has ended; 'astrolabe drive' begins another");
    console::say(paused ? "the robot goes on" : robot::kNotPaused);
  });
}

}  // namespace astro::commands
