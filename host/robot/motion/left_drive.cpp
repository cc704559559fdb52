#include "host/robot/motion/left_drive.hpp"

#include "host/robot/motion/other_program.hpp"

namespace astro::robot {

bool stop_left_drive(Client& client, microseconds command_timeout) {
  constexpr RetryPolicy kPatience{std::chrono::milliseconds(60), 8};
  constexpr microseconds kLongestTrusted =
      std::chrono::seconds(1);  // by then the robot has stopped by itself
  if (command_timeout > microseconds::zero() && command_timeout <= kLongestTrusted) return false;
  // The mode first: a program that begins to drive after that is among those that are asked for next.
  const protocol::Mode mode = client.request(protocol::GetStatus{}, kPatience).mode;
  if (!protocol::gives_power(mode) || mode == protocol::Mode::stopping) return false;
  if (port_users(client).driver_pid != 0) return false;
  client.request(protocol::Stop{}, kPatience);
  return true;
}

}  // namespace astro::robot
