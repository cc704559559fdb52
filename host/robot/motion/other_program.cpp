#include "host/robot/motion/other_program.hpp"

#include "host/robot/motion/arming.hpp"
#include "host/robot/motion/drive_problem.hpp"
#include "host/robot/sharing/port_user.hpp"

namespace astro::robot {

PortUsers port_users(Client& client) {
  try {
    return client.request(GetPortUsers{}, {.timeout = std::chrono::milliseconds(60), .tries = 3});
  } catch (const Error&) {
    return {};
  }
}

std::string another_program(std::uint32_t pid, const CommandLine& command) {
  return pid == 0 ? "another program" : "another program (" + in_words(pid, command.view()) + ")";
}

std::vector<std::string> with_program(std::vector<std::string> values, std::uint32_t pid,
                                      const CommandLine& command) {
  if (pid != 0) values.insert(values.end(), {std::to_string(pid), std::string(command.view())});
  return values;
}

Remark driven_by_another(const PortUsers& users) {
  return {"the robot is driving for " + another_program(users.driver_pid, users.driver_command),
          DriveProblem::driven_by_another, with_program({}, users.driver_pid, users.driver_command)};
}

Remark stopped_by_another(const PortUsers& users) {
  return {another_program(users.stopper_pid, users.stopper_command) + " has stopped the robot",
          DriveProblem::stopped_by_another, with_program({}, users.stopper_pid, users.stopper_command)};
}

Remark why_refused(Client& client, const RobotRefused& refused) {
  if (refused.code() == protocol::ErrorCode::busy)
    if (const PortUsers users = port_users(client); users.driver_pid != 0) return driven_by_another(users);
  if (refused.code() == protocol::ErrorCode::not_armed)
    if (const PortUsers users = port_users(client); users.stopper_pid != 0) return stopped_by_another(users);
  return refused.remark();
}

bool stop_left_drive(Client& client, microseconds command_timeout) {
  constexpr RetryPolicy kPatience{std::chrono::milliseconds(60), 8};
  constexpr microseconds kLongestTrusted =
      std::chrono::seconds(1);  // by then the robot has stopped by itself
  if (command_timeout > microseconds::zero() && command_timeout <= kLongestTrusted) return false;
  // The mode is read first: a program that begins to drive after that is found by port_users().
  const protocol::Mode mode = client.request(protocol::GetStatus{}, kPatience).mode;
  if (!protocol::gives_power(mode) || mode == protocol::Mode::stopping) return false;
  if (port_users(client).driver_pid != 0) return false;
  client.request(protocol::Stop{}, kPatience);
  return true;
}

}  // namespace astro::robot
