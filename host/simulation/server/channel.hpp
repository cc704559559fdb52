#pragma once

#include <poll.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "host/simulation/server/pty.hpp"
#include "host/simulation/server/served.hpp"

namespace astro::simulation {

/// One port of a robot at one pty. The pty is there while the robot's port is.
class Channel {
 public:
  /// Errors as Pty.
  Channel(Served& robot, int port, std::filesystem::path link);

  /// Brings the robot what the host has sent; false if that is nothing.
  bool receive();
  /// Brings the host what the robot has sent; true if it has not taken all yet.
  bool transmit();
  /// Follows the robot's port and the host's program as they come and go.
  void look();

  bool connected() const { return connected_; }
  /// For poll(), while connected.
  pollfd waits_for() const;

 private:
  Served& robot_;
  int port_;
  std::filesystem::path link_;
  std::optional<Pty> pty_;
  bool connected_ = false;
  std::vector<std::uint8_t> outgoing_;
};

}  // namespace astro::simulation
