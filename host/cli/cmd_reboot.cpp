#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/connection.hpp"
#include "host/cli/console.hpp"
#include "host/cli/options.hpp"

namespace astro::cli {

void add_reboot(CLI::App& app) {
  struct Options {
    ConnectionOptions connection;
    bool bootloader = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("reboot", "start the robot again; outputs off first");
  add_connection(command, options->connection);
  command.add_flag("--bootloader", options->bootloader, "wait for new firmware instead of starting");
  examples(command, {"astrolabe reboot", "astrolabe reboot --bootloader"});
  command.callback([options] {
    const auto client = connect(options->connection);
    if (options->bootloader) {
      client->request(protocol::EnterBootloader{});
    } else {
      client->request(protocol::Reboot{});
    }
    say(options->bootloader ? "the robot waits for new firmware" : "the robot starts again");
  });
}

}  // namespace astro::cli
