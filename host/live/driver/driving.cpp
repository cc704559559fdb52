#include "host/live/driver/driving.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/robot/motion/arming.hpp"
#include "host/robot/motion/other_program.hpp"
#include "host/robot/motion/rest.hpp"

namespace astro::live {

using std::chrono::milliseconds;

namespace {

bool all_finite(const ros2::msg::Vector3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Limits a command to what a message can hold, which is faster than any robot. Both values are reduced by one factor, so
/// that the curvature stays, as it does when the robot reduces a command to its limits.
protocol::Velocity to_velocity(double v_mps, double omega_radps) {
  constexpr double kMostInMessage = 2000;
  const double share =
      std::min(1.0, kMostInMessage / std::max({std::abs(v_mps), std::abs(omega_radps), 1.0}));
  const auto micro = [&](double value) {
    return static_cast<std::int32_t>(std::lround(1e6 * share * value));
  };
  return {micro(v_mps), micro(omega_radps)};
}

std::string text_of(microseconds time) { return to_text(1e-6 * static_cast<double>(time.count())) + " s"; }

double number(RobotSession& session, const char* name, double otherwise) {
  const auto found = session.numbers().find(name);
  return found == session.numbers().end() ? otherwise : found->second;
}

/// After this time a velocity is sent again, so that the robot may miss three in a row before its time-out.
microseconds refresh_of(RobotSession& session) {
  constexpr double kSlowest_ms = 50;
  const double timeout_ms = number(session, "command_timeout", 0);
  return microseconds(
      std::llround(1e3 * (timeout_ms > 0 ? std::min(timeout_ms / 4, kSlowest_ms) : kSlowest_ms)));
}

bool beyond_limits(RobotSession& session, const protocol::Velocity& velocity) {
  return std::abs(1e-6 * velocity.v_umps) > number(session, "speed_limit", HUGE_VAL) ||
         std::abs(1e-6 * velocity.omega_uradps) > number(session, "yaw_rate_limit", HUGE_VAL);
}

/// Waits some 0.6 s at most for the robot to come to rest. False if it has not.
bool comes_to_rest(RobotSession& session) {
  for (int i = 0; i < 12; ++i) {
    if (!protocol::gives_power(session.ask(protocol::GetStatus{}).mode)) return true;
    session.client().pump(milliseconds(50));
  }
  return false;
}

/// The robot takes all programs that drive through one port for one host. So it would let this program take over a path that
/// another one has left behind, which is refused here.
void require_free(RobotSession& session, const protocol::Status& status) {
  const bool drives = protocol::gives_power(status.mode) && status.mode != protocol::Mode::stopping;
  if (!drives && status.queued_segments == 0) return;  // what is left of a paused path waits in the queue
  if (robot::port_users(session.client()).driver_pid == 0)
    throw Error("the robot drives, or waits on a path, for another program");
}

}  // namespace

std::optional<std::string> VelocityCommand::take(const ros2::msg::Twist& twist, const Moment& now) {
  if (now.waited >= timeout_)
    return "it may have waited for " + text_of(now.waited) + "; the time-out is " + text_of(timeout_);
  return hold(twist, now.steady + timeout_ - now.waited);
}

std::optional<std::string> VelocityCommand::take(const ros2::msg::TwistStamped& twist, const Moment& now) {
  const std::int64_t stamp_ns = ros2::msg::nanoseconds(twist.header.stamp);
  if (stamp_ns == 0) return take(twist.twist, now);
  const microseconds age((now.utc_ns - stamp_ns) / 1000);
  if (age > timeout_) return "its stamp is " + text_of(age) + " old; the time-out is " + text_of(timeout_);
  if (age < -kFutureTolerance) return "its stamp is " + text_of(-age) + " in the future";
  return hold(twist.twist, now.steady + timeout_ - std::max(age, microseconds::zero()));
}

std::optional<std::string> VelocityCommand::hold(const ros2::msg::Twist& twist, microseconds until) {
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

std::string Driving::arm(RobotSession& session) {
  // The robot needs this request, too: it accepts an Arm only from a host that can know of every stop.
  const protocol::Status status = session.ask(protocol::GetStatus{});
  if (!armed_) require_free(session, status);
  const std::optional<Remark> cleared = robot::clear_faults_left_behind(
      session.client(),
      [&] {
        if (!comes_to_rest(session)) throw Error("the robot is not armed yet: it still ramps to rest");
      },
      RobotSession::kPatience);
  try {
    session.ask(protocol::Arm{});
  } catch (const robot::RobotRefused& refused) {
    throw Error(robot::why_refused(session.client(), refused));
  }
  command_.clear();
  armed_ = true;
  halt_ = Halt::none;
  return cleared ? "armed; " + cleared->sentence : "armed";
}

void Driving::disarm(RobotSession& session) {
  session.ask(protocol::Disarm{});
  release();
}

std::string Driving::stop(RobotSession& session) {
  command_.clear();
  if (velocities_after_stop_ && armed_ && halt_ == Halt::none) {
    try {
      session.ask(protocol::Rest{});
      return "ramps to rest, and goes on with the next velocity";
    } catch (const robot::RobotRefused&) {  // somebody else has stopped the robot
    }
  }
  session.ask(protocol::Stop{});
  halt_ = Halt::stopped;
  return "ramps to rest, and moves for nobody until it is armed again";
}

void Driving::pause(RobotSession& session) {
  command_.clear();
  session.ask(protocol::Pause{});
  if (halt_ == Halt::none) halt_ = Halt::paused;
}

std::string Driving::resume(RobotSession& session) {
  const bool paused =
      halt_ == Halt::paused || session.ask(protocol::GetStatus{}).mode == protocol::Mode::paused;
  session.ask(protocol::Resume{});
  if (halt_ == Halt::paused) halt_ = Halt::none;
  return paused ? "resumed" : robot::kNotPaused;
}

void Driving::release() {
  command_.clear();
  armed_ = false;
}

void Driving::step(RobotSession& session, microseconds now) {
  switch (command_.due(now, refresh_of(session))) {
    case VelocityCommand::Due::nothing:
      return;
    case VelocityCommand::Due::stop:
      return send_rest(session, now);
    case VelocityCommand::Due::velocity:
      return send(session, now);
  }
}

void Driving::send_rest(RobotSession& session, microseconds now) {
  if (!armed_) return;
  try {
    session.ask(protocol::Rest{});
  } catch (const robot::RobotRefused& refused) {  // another program has it, or it is at rest with a fault
    release();
    ignore(robot::why_refused(session.client(), refused).sentence, now);
  }
}

void Driving::send(RobotSession& session, microseconds now) {
  if (const std::string_view why = why_ignored(); !why.empty()) {
    command_.clear();
    return ignore(std::string(why), now);
  }
  try {
    session.ask(command_.velocity());
    counts_.reduced = beyond_limits(session, command_.velocity());
  } catch (const robot::RobotRefused& refused) {
    release();
    ignore(robot::why_refused(session.client(), refused).sentence, now);
  }
}

std::string_view Driving::why_ignored() const {
  if (!armed_) return "the robot is not armed";
  switch (halt_) {
    case Halt::stopped:
      return "the robot was stopped and must be armed again";
    case Halt::paused:
      return "the robot is paused";
    default:
      return "";
  }
}

void Driving::ignore(const std::string& why, microseconds now) {
  ++counts_.ignored;
  counts_.last_reason = why;
  counts_.ignored_at = now;
}

}  // namespace astro::live
