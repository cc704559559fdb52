#include <fmt/format.h>

#include <memory>

#include "host/commands/robot/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/restart.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"

namespace astro::commands {
namespace {

struct RebootOptions {
  ConnectionOptions connection;
  bool bootloader = false;
};

void run(RebootOptions& options) {
  const auto client = connect(options.connection);
  if (options.bootloader) {
    request_restart<protocol::EnterBootloader>(*client);
    return console::say(
        "the robot is on its way into its boot loader, where it waits for 'astrolabe flash --button'");
  }
  request_restart<protocol::Reboot>(*client);
  client->reconnect(std::chrono::seconds(10));
  const protocol::Status status = client->request(protocol::GetStatus{});
  console::say(fmt::format("the robot is back ({}), {}", protocol::name(status.reset_cause),
                           protocol::name(status.mode)));
}

}  // namespace

void add_reboot(console::Command app) {
  const auto options = std::make_shared<RebootOptions>();
  const console::Command command = app.add_subcommand("reboot", "restart the robot, which must be at rest");
  command.add_flag("--bootloader", options->bootloader, "stay in the bootloader and wait for new firmware");
  add_connection(command, options->connection);
  console::examples(command, {"astrolabe reboot", "astrolabe reboot --bootloader --port /dev/ttyACM0"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
