#include "host/ros2/driver/velocity_command.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/text/numbers.hpp"

namespace astro::ros2 {
namespace {

bool all_finite(const msg::Vector3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// What a message to the robot can hold and no robot can do: faster commands keep their curvature, as the robot keeps it when
/// it reduces a command to its limits.
protocol::Velocity to_velocity(double v_mps, double omega_radps) {
  constexpr double kMost = 2000;
  const double share = std::min(1.0, kMost / std::max({std::abs(v_mps), std::abs(omega_radps), 1.0}));
  const auto micro = [&](double value) {
    return static_cast<std::int32_t>(std::lround(1e6 * share * value));
  };
  return {micro(v_mps), micro(omega_radps)};
}

std::string text_of(microseconds time) { return to_text(1e-6 * static_cast<double>(time.count())) + " s"; }

}  // namespace

std::optional<std::string> VelocityCommand::take(const msg::Twist& twist, const Moment& now) {
  if (now.waited >= timeout_)
    return "it may have waited for " + text_of(now.waited) + "; the time-out is " + text_of(timeout_);
  return hold(twist, now.steady + timeout_ - now.waited);
}

std::optional<std::string> VelocityCommand::take(const msg::TwistStamped& twist, const Moment& now) {
  const std::int64_t stamp_ns = msg::nanoseconds(twist.header.stamp);
  if (stamp_ns == 0) return take(twist.twist, now);
  const microseconds age((now.utc_ns - stamp_ns) / 1000);
  if (age > timeout_) return "its stamp is " + text_of(age) + " old; the time-out is " + text_of(timeout_);
  if (age < -kFutureTolerance) return "its stamp is " + text_of(-age) + " in the future";
  return hold(twist.twist, now.steady + timeout_ - std::max(age, microseconds::zero()));
}

std::optional<std::string> VelocityCommand::hold(const msg::Twist& twist, microseconds until) {
  if (!all_finite(twist.linear) || !all_finite(twist.angular)) return "it holds NaN or infinity";
  held_ = Held{to_velocity(twist.linear.x, twist.angular.z), until, std::nullopt};
  return std::nullopt;
}

VelocityCommand::Due VelocityCommand::due(microseconds now, microseconds refresh) {
  if (!held_) return Due::nothing;
  if (now >= held_->until) {
    held_.reset();
    return Due::stop;
  }
  if (held_->sent && now - *held_->sent < refresh) return Due::nothing;
  held_->sent = now;
  return Due::velocity;
}

}  // namespace astro::ros2
