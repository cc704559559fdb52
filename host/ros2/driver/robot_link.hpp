#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "host/ros2/driver/host_clock.hpp"
#include "host/ros2/driver/robot_session.hpp"

namespace astro::ros2 {

/// Opens the robot's port; throws astro::Error with the reason if that is not possible now.
using OpenPort = std::function<std::unique_ptr<robot::Transport>()>;

/// The way to one robot, which may not be there yet, go away and come back. The first robot that answers is the one: another
/// one at the same port is not taken for it, because its odometry and its parameters are others.
class RobotLink {
 public:
  RobotLink(OpenPort open, HostClock clock, std::uint16_t telemetry_period_ms)
      : open_(std::move(open)), clock_(std::move(clock)), period_ms_(telemetry_period_ms) {}

  /// Null while there is no robot.
  RobotSession* session() { return session_.get(); }

  /// Tries to reach the robot, if it is time for another try. True if there is a session now, a new one.
  bool seek();
  /// The session has ended, for this reason.
  void lose(const Error& why);

  /// Why there is no session.
  const Error& why() const { return why_; }
  /// The robot that answered first.
  const std::optional<protocol::HelloReply>& robot() const { return robot_; }
  /// How many times it was lost.
  int losses() const { return losses_; }

 private:
  OpenPort open_;
  HostClock clock_;
  std::uint16_t period_ms_;
  std::unique_ptr<RobotSession> session_;
  std::optional<protocol::HelloReply> robot_;
  Error why_{"no robot was found yet"};
  std::optional<microseconds> tried_;
  int losses_ = 0;
};

}  // namespace astro::ros2
