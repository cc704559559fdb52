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

/// As which type velocities are taken where two types of one name are trouble (Middleware::types_may_share_a_name).
enum class CommandType { twist_stamped, twist, both };
inline constexpr std::array<std::string_view, 3> kCommandTypeNames{"TwistStamped", "Twist", "both"};
constexpr std::string_view name(CommandType type) {
  return kCommandTypeNames[static_cast<std::size_t>(type)];
}

/// One moment on both clocks of this computer.
struct Moment {
  microseconds steady{};
  std::int64_t utc_ns = 0;
  microseconds waited{};  // at most: what has come may have waited so long until somebody took it
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

  /// Each returns why it refuses the velocity, and then has changed nothing.
  std::optional<std::string> take(const ros2::msg::Twist& twist, const Moment& now);
  std::optional<std::string> take(const ros2::msg::TwistStamped& twist, const Moment& now);
  void clear() { held_.reset(); }

  /// What the robot is to be told at this moment.
  enum class Due { nothing, velocity, stop };
  /// `velocity` for a new one, and again `refresh` after it was sent last; `stop` once, when it is over.
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

}  // namespace astro::live
