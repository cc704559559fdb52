#include <memory>

#include "host/commands/drive/ask_driven.hpp"
#include "host/commands/drive/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"

namespace astro::commands {

void add_resume(console::Command app) {
  const auto options = std::make_shared<ConnectionOptions>();
  const console::Command command = app.add_subcommand("resume", "let a paused robot go on");
  add_connection(command, *options);
  console::examples(command, {"astrolabe resume"});
  command.callback([options] {
    ask_driven(
        *connect(*options), protocol::Resume{},
        "there is nothing to resume: the drive was stopped or has ended; 'astrolabe drive' begins another");
    console::say("the robot goes on");
  });
}

}  // namespace astro::commands
