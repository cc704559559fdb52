#pragma once

#include <poll.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "host/simulation/server/pty.hpp"
#include "host/simulation/server/served_robot.hpp"

namespace astro::simulation {

/// One port of a robot at one pty. The pty exists while the robot's port does.
class Channel {
 public:
  /// Errors as Pty.
  Channel(ServedRobot& robot, int port, std::filesystem::path link);

  /// Passes bytes from the host to the robot; returns false if there were none.
  bool receive();
  /// Passes bytes from the robot to the host; returns true if some are left because the host has not taken
  /// them.
  bool transmit();
  /// Follows changes: the robot's port appears or disappears, a program opens or closes the pty.
  void update_connection();

  bool connected() const { return connected_; }
  /// For poll(), while connected.
  pollfd waits_for() const;

 private:
  ServedRobot& robot_;
  int port_;
  std::filesystem::path link_;
  std::optional<Pty> pty_;
  bool connected_ = false;
  std::vector<std::uint8_t> outgoing_;
};

}  // namespace astro::simulation
