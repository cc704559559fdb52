#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/connection.hpp"
#include "host/cli/console.hpp"
#include "host/cli/options.hpp"

namespace astro::cli {

void add_stop(CLI::App& app) {
  struct Options {
    ConnectionOptions connection;
    bool emergency = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("stop", "stop the robot");
  add_connection(command, options->connection);
  command.add_flag("--emergency", options->emergency, "outputs off at once, latched; else ramps to rest");
  examples(command, {"astrolabe stop", "astrolabe stop --emergency --port /dev/ttyACM0"});
  command.callback([options] {
    const auto client = connect(options->connection);
    if (options->emergency) {
      client->request(protocol::EmergencyStop{});
      say("outputs are off; 'astrolabe faults --clear' takes the emergency stop back");
    } else {
      client->request(protocol::Stop{});
      say("the robot ramps to rest");
    }
  });
}

}  // namespace astro::cli
