#include <memory>

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
    connect(*options)->request(protocol::Resume{});
    console::say("the robot goes on");
  });
}

}  // namespace astro::commands
