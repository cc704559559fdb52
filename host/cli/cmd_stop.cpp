#include <memory>

#include "host/base/error.hpp"
#include "host/cli/command.hpp"
#include "host/cli/connection.hpp"
#include "host/cli/console.hpp"
#include "host/cli/options.hpp"

namespace astro::cli {
namespace {

struct StopOptions {
  ConnectionOptions connection;
  bool emergency = false;
};

void ramp_to_rest(link::Client& client) {
  constexpr auto kTimeToRest = std::chrono::seconds(5);
  client.request(protocol::Stop{});
  const link::microseconds deadline = client.now() + kTimeToRest;
  while (!protocol::at_rest(client.request(protocol::GetStatus{}).mode)) {
    if (client.now() >= deadline)
      throw Error("the robot does not come to rest: try 'astrolabe stop --emergency' or switch it off");
    client.pump(std::chrono::milliseconds(50));
  }
  client.request(protocol::Disarm{});
  say("the robot is at rest and disarmed");
}

void run(StopOptions& options) {
  const auto client = connect(options.connection);
  if (!options.emergency) return ramp_to_rest(*client);
  client->request(protocol::EmergencyStop{});
  say("the motors are off and stay off until 'astrolabe faults --clear'");
}

}  // namespace

void add_stop(Command app) {
  const auto options = std::make_shared<StopOptions>();
  const Command command = app.add_subcommand(
      "stop", "let the robot ramp to rest and disarm it, also while another program drives it");
  command.add_flag("--emergency", options->emergency,
                   "motors off at once; they stay off until the fault is cleared");
  add_connection(command, options->connection);
  examples(command, {"astrolabe stop", "astrolabe stop --emergency --port /dev/ttyACM0"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::cli
