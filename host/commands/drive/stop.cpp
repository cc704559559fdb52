#include <memory>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/drive/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/drive_problem.hpp"
#include "host/robot/motion/rest.hpp"

namespace astro::commands {
namespace {

struct StopOptions {
  ConnectionOptions connection;
  bool emergency = false;
};

void ramp_to_rest(robot::Client& client) {
  client.request(protocol::Stop{});
  const bool rests = robot::wait_until_power_off(client);
  const protocol::Status status = client.request(protocol::GetStatus{});
  client.request(protocol::Disarm{});
  if (!rests)
    throw Error("the robot did not come to rest, so it was disarmed: its motors are off, but it may roll on");
  if (status.latched_faults == 0) return console::say("the robot is at rest and disarmed");
  // A fault has opened the bridges, so the robot may still roll.
  const std::string faults = faults_in_words(status.latched_faults);
  if (!robot::wait_until_wheels_stopped(client))
    throw Error("the robot rolls on with its motors off (" + faults +
                "): 'astrolabe faults' says what to do about it");
  console::say("the robot has stopped and is disarmed; its motors are off because of " + faults +
               ": see 'astrolabe faults'");
}

void run(StopOptions& options) {
  const auto client = connect(options.connection);
  if (!options.emergency) return ramp_to_rest(*client);
  client->request(protocol::EmergencyStop{});
  console::say("the motors are off and stay off until 'astrolabe faults --clear'");
}

constexpr Advice kStopAdvice[] = {
    {robot::DriveProblem::armed_for_another, ": end that one, or 'astrolabe stop' ends its drive"},
    {robot::DriveProblem::driven_by_another, ": end that one, or 'astrolabe stop' ends its drive"},
};

}  // namespace

void add_stop(console::Command app) {
  advise(kStopAdvice);
  const auto options = std::make_shared<StopOptions>();
  const console::Command command = app.add_subcommand(
      "stop", "let the robot ramp to rest and disarm it, also while another program drives it");
  command.add_flag("--emergency", options->emergency,
                   "motors off at once; they stay off until the fault is cleared");
  add_connection(command, options->connection);
  console::examples(command, {"astrolabe stop", "astrolabe stop --emergency --port /dev/ttyACM0"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
