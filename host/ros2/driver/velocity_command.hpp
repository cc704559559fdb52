#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/protocol/motion.hpp"
#include "host/base/microseconds.hpp"
#include "host/ros2/messages/geometry.hpp"

namespace astro::ros2 {

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
  std::optional<std::string> take(const msg::Twist& twist, const Moment& now);
  std::optional<std::string> take(const msg::TwistStamped& twist, const Moment& now);
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

  std::optional<std::string> hold(const msg::Twist& twist, microseconds until);

  microseconds timeout_;
  std::optional<Held> held_;
};

}  // namespace astro::ros2
