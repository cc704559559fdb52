#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/ros2/driver/robot_session.hpp"
#include "host/ros2/driver/velocity_command.hpp"

namespace astro::ros2 {

/// What became of the velocities that others commanded.
struct CommandCounts {
  std::uint64_t received = 0, ignored = 0;
  std::string last_reason;                 // of one that was ignored
  std::optional<microseconds> ignored_at;  // the last one
  bool reduced = false;                    // the last one that was sent is beyond the robot's limits
};

/// Drives the robot by the velocities that others command, once one of them has armed it through this node. Nothing arms by
/// itself: a fault, a lost link, a restart, a stop or another program that stops the robot ends the permission.
class Driving {
 public:
  /// With `velocities_after_stop` the next velocity after stop() drives the robot again, unless somebody outside this node has
  /// stopped it, too.
  explicit Driving(microseconds cmd_vel_timeout, bool velocities_after_stop = false)
      : command_(cmd_vel_timeout), velocities_after_stop_(velocities_after_stop) {}

  /// Arms the robot; returns what was done. Clears the faults that an earlier drive left behind.
  /// Throws astro::Error for any other latched fault, and if another program drives.
  std::string arm(RobotSession& session);
  void disarm(RobotSession& session);
  /// Ramps to rest, whoever drives; returns what was done. Then the robot moves for nobody until an arm, unless
  /// `velocities_after_stop` holds and this node drives.
  std::string stop(RobotSession& session);
  /// Ramps to rest, and keeps what is left of a path. Until resume() or arm() velocities are ignored.
  void pause(RobotSession& session);
  void resume(RobotSession& session);
  /// The robot is not armed for this node any more.
  void release();
  bool armed() const { return armed_; }
  /// Why velocities are ignored; "" if they drive the robot.
  std::string_view why_ignored() const;

  /// A velocity has come: a Twist or a TwistStamped, as bytes.
  template <class Message>
  void take(const std::optional<Message>& message, const Moment& now) {
    ++counts_.received;
    const auto refused = message ? command_.take(*message, now) : std::optional<std::string>("it is damaged");
    if (refused) ignore(*refused, now.steady);
  }

  /// Tells the robot what is due: a new velocity at once, the same one again before the robot's own time-out, Rest at the end.
  void step(RobotSession& session, microseconds now);

  const CommandCounts& counts() const { return counts_; }

 private:
  void send(RobotSession& session, microseconds now);
  void send_rest(RobotSession& session, microseconds now);
  void ignore(const std::string& why, microseconds now);

  /// What keeps velocities from an armed robot.
  enum class Halt : std::uint8_t { none, stopped, paused };

  VelocityCommand command_;
  bool velocities_after_stop_;
  bool armed_ = false;
  Halt halt_ = Halt::none;
  CommandCounts counts_;
};

}  // namespace astro::ros2
