#include <memory>

#include "host/base/error.hpp"
#include "host/cli/command.hpp"
#include "host/cli/connection.hpp"
#include "host/cli/console.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/options.hpp"
#include "host/cli/robot_view.hpp"

namespace astro::cli {
namespace {

void pause(ConnectionOptions& options) {
  const auto client = connect(options);
  constexpr auto kTimeToRest = std::chrono::seconds(5);
  client->request(protocol::Pause{});
  const link::microseconds deadline = client->now() + kTimeToRest;
  while (protocol::gives_power(client->request(protocol::GetStatus{}).mode)) {
    if (interrupted() || client->now() >= deadline)
      throw Error("the robot has not come to rest: 'astrolabe stop' stops it");
    client->pump(std::chrono::milliseconds(50));
  }
  const protocol::Status status = client->request(protocol::GetStatus{});
  if (status.mode != protocol::Mode::paused)
    throw Error("the robot is not paused but " + std::string(protocol::name(status.mode)) +
                ", faults: " + faults_in_words(status.latched_faults));
  say("the robot waits on its path until 'astrolabe resume'; 'astrolabe stop' ends the drive");
}

void resume(ConnectionOptions& options) {
  connect(options)->request(protocol::Resume{});
  say("the robot goes on");
}

Command add(Command app, const char* name, const char* what, void (*run)(ConnectionOptions&)) {
  const auto options = std::make_shared<ConnectionOptions>();
  const Command command = app.add_subcommand(name, what);
  add_connection(command, *options);
  command.callback([options, run] { run(*options); });
  return command;
}

}  // namespace

void add_pause(Command app) {
  examples(add(app, "pause", "let a robot that drives a path come to rest on it", pause),
           {"astrolabe pause", "astrolabe pause --port /dev/ttyS0"});
  examples(add(app, "resume", "let a paused robot go on", resume), {"astrolabe resume"});
}

}  // namespace astro::cli
