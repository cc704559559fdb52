#include "host/robot/motion/other_program.hpp"

#include "host/robot/sharing/port_socket.hpp"

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
