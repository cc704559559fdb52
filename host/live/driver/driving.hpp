#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/protocol/motion.hpp"
#include "host/base/microseconds.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/live/driver/robot_link.hpp"

namespace astro::live {

/// The message types from which velocities are taken, on a middleware where the types of one topic name should not differ
/// (Middleware::types_may_share_a_name).
enum class CommandType { twist_stamped, twist, both };
inline constexpr std::array<std::string_view, 3> kCommandTypeNames{"TwistStamped", "Twist", "both"};
constexpr std::string_view name(CommandType type) {
  return kCommandTypeNames[static_cast<std::size_t>(type)];
}

/// One moment on both clocks of this computer.
struct Moment {
  microseconds steady{};
  std::int64_t utc_ns = 0;
  microseconds waited{};  // the longest time that a message may have waited until it was taken
};

/// The velocity that others command, by the rules of diff_drive_controller:
///   - a velocity holds for the time-out from its stamp, one without a stamp (0, or a Twist) from the earliest moment at which it
///     can have come; one that may have waited longer than the time-out is refused;
///   - NaN and infinity are refused, and so is a stamp that is older than the time-out or later than now by more than
///     kFutureTolerance, which means that the clocks of both computers differ;
///   - of the six components, those that a differential drive cannot do are ignored.
class VelocityCommand {
 public:
  static constexpr microseconds kFutureTolerance = std::chrono::milliseconds(100);

  explicit VelocityCommand(microseconds timeout) : timeout_(timeout) {}

  /// Each returns nothing if it takes the velocity. If it refuses it, it returns why and changes nothing.
  std::optional<std::string> take(const ros2::msg::Twist& twist, const Moment& now);
  std::optional<std::string> take(const ros2::msg::TwistStamped& twist, const Moment& now);
  void clear() { held_.reset(); }

  /// What has to be sent to the robot now.
  enum class Due { nothing, velocity, stop };
  /// `velocity` if there is a new one, and again when `refresh` has passed since it was sent last; `stop` once, when it has
  /// timed out.
  Due due(microseconds now, microseconds refresh);
  /// Precondition: due() said `velocity`.
  const protocol::Velocity& velocity() const { return held_->velocity; }

 private:
  struct Held {
    protocol::Velocity velocity;
    microseconds until{};
    std::optional<microseconds> sent;
  };

  std::optional<std::string> hold(const ros2::msg::Twist& twist, microseconds until);

  microseconds timeout_;
  std::optional<Held> held_;
};

/// What became of the velocities that others commanded.
struct CommandCounts {
  std::uint64_t received = 0, ignored = 0;
  std::string last_reason;                 // of one that was ignored
  std::optional<microseconds> ignored_at;  // the last one
  bool reduced = false;                    // the last one that was sent is beyond the robot's limits
};

/// Drives the robot by the velocities that others command, once one of them has armed it through this node. A fault, a lost
/// link, a restart, a stop, or another program that stops the robot ends that, and the robot has to be armed again (unless
/// `velocities_after_stop` allows otherwise).
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
  /// Ramps the robot to rest, whoever drives it; returns what was done. Then the robot does not move until it is armed again,
  /// unless `velocities_after_stop` is set and this node drives.
  std::string stop(RobotSession& session);
  /// Ramps the robot to rest and keeps the rest of its path. Velocities are ignored until resume() or arm().
  void pause(RobotSession& session);
  /// Returns what was done.
  std::string resume(RobotSession& session);
  /// To be called when the robot is no longer armed for this node.
  void release();
  bool armed() const { return armed_; }
  /// Why velocities are ignored; "" if they drive the robot.
  std::string_view why_ignored() const;

  /// Takes a velocity that has come, a Twist or a TwistStamped; nothing if its bytes could not be decoded.
  template <class Message>
  void take(const std::optional<Message>& message, const Moment& now) {
    ++counts_.received;
    const auto refused = message ? command_.take(*message, now) : std::optional<std::string>("it is damaged");
    if (refused) ignore(*refused, now.steady);
  }

  /// Sends what is due: a new velocity at once, the same one again before the robot's own time-out, Rest when it has timed
  /// out.
  void step(RobotSession& session, microseconds now);

  const CommandCounts& counts() const { return counts_; }

 private:
  void send(RobotSession& session, microseconds now);
  void send_rest(RobotSession& session, microseconds now);
  void ignore(const std::string& why, microseconds now);

  /// Why velocities do not drive an armed robot.
  enum class Halt : std::uint8_t { none, stopped, paused };

  VelocityCommand command_;
  bool velocities_after_stop_;
  bool armed_ = false;
  Halt halt_ = Halt::none;
  CommandCounts counts_;
};

}  // namespace astro::live
