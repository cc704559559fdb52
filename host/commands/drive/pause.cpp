#include <memory>

#include "host/base/error.hpp"
#include "host/commands/drive/ask_driven.hpp"
#include "host/commands/drive/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"

namespace astro::commands {
namespace {

void pause(ConnectionOptions& options) {
  const auto client = connect(options);
  constexpr auto kTimeToRest = std::chrono::seconds(5);
  ask_driven(*client, protocol::Pause{}, "there is nothing to pause: nobody drives the robot");
  const microseconds deadline = client->now() + kTimeToRest;
  while (protocol::gives_power(client->request(protocol::GetStatus{}).mode)) {
    if (console::interrupted() || client->now() >= deadline)
      throw Error("the robot has not come to rest: 'astrolabe stop' stops it");
    client->pump(std::chrono::milliseconds(50));
  }
  const protocol::Status status = client->request(protocol::GetStatus{});
  if (status.latched_faults != 0)
    throw Error("the robot has stopped because of a fault: " + faults_in_words(status.latched_faults));
  if (status.mode != protocol::Mode::paused)  // a program that drives by velocities ends when one is refused
    return console::say("the robot is at rest; the program that drove it has ended its drive");
  console::say("the robot is at rest until 'astrolabe resume'; 'astrolabe stop' ends the drive");
}

}  // namespace

void add_pause(console::Command app) {
  const auto options = std::make_shared<ConnectionOptions>();
  const console::Command command =
      app.add_subcommand("pause", "let the robot come to rest, on its path if it drives one");
  add_connection(command, *options);
  console::examples(command, {"astrolabe pause", "astrolabe pause --port /dev/ttyS0"});
  command.callback([options] { pause(*options); });
}

}  // namespace astro::commands
