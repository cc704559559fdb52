#include "firmware/app/drive.hpp"

namespace astro {
namespace {

constexpr std::int32_t kStanding_umps = 3'000;      // slower than this is standing: about 40 counts a second
constexpr std::uint32_t kSettled_ticks = 50;        // and for so long
constexpr std::uint32_t kSettleAtMost_ticks = 700;  // a robot held by friction is as settled as it will be

// Scales both components, so that a command beyond the limits keeps its curvature.
BodyTwist within(const BodyTwist& twist, const MotionLimits& limits) {
  const std::int64_t v = twist.v_umps < 0 ? -std::int64_t{twist.v_umps} : twist.v_umps;
  const std::int64_t omega = twist.omega_uradps < 0 ? -std::int64_t{twist.omega_uradps} : twist.omega_uradps;
  BodyTwist scaled = twist;
  if (v > limits.speed_umps && v * limits.yaw_rate_uradps >= omega * limits.speed_umps) {
    scaled.v_umps = static_cast<std::int32_t>(std::int64_t{twist.v_umps} * limits.speed_umps / v);
    scaled.omega_uradps = static_cast<std::int32_t>(std::int64_t{twist.omega_uradps} * limits.speed_umps / v);
  } else if (omega > limits.yaw_rate_uradps) {
    scaled.v_umps = static_cast<std::int32_t>(std::int64_t{twist.v_umps} * limits.yaw_rate_uradps / omega);
    scaled.omega_uradps =
        static_cast<std::int32_t>(std::int64_t{twist.omega_uradps} * limits.yaw_rate_uradps / omega);
  }
  return scaled;
}

}  // namespace

void Drive::configure(const ParameterSet& set) {
  geometry_ = make_geometry(set);
  limits_ = make_limits(set);
  ramp_.set_limits(limits_);
  command_timeout_us_ = static_cast<std::uint64_t>(set.get(Param::command_timeout)) * 1000;
  odometry_.set_geometry(geometry_);
  wheels_.configure(set, geometry_);
  follower_.set_gains(set);
  supervisor_.configure(set);
}

Drive::Output Drive::advance(const TickInput& input) {
  now_us_ = input.now_us;
  const Wheels::Steps steps = wheels_.read(input);
  odometry_.advance(steps.left, steps.right);
  watch_over(input, supervisor_.advance(input, steps.plausible, !at_rest(), wheels_));
  return output(wish(), input);
}

void Drive::watch_over(const TickInput& input, std::uint32_t found) {
  if (found != 0) faults_.raise_all(found, input.now_us);
  if (faults_.any() && mode_ != Mode::fault && !fault_after_stop_) enter_fault();
  if (mode_ != Mode::velocity && mode_ != Mode::segment && mode_ != Mode::wheels) return;
  if (input.now_us <= (mode_ == Mode::segment ? host_deadline_us_ : velocity_deadline_us_)) return;
  faults_.raise(mode_ == Mode::segment ? Fault::link_lost : Fault::command_timeout, input.now_us);
  if (mode_ == Mode::wheels) return enter_fault();  // there is no ramp without a loop
  // Nobody steers any more: ramp to rest, then off.
  stop();
  fault_after_stop_ = true;
}

bool Drive::arm() {
  if (faults_.any()) return false;
  if (mode_ == Mode::disarmed) mode_ = Mode::idle;
  return true;
}

void Drive::disarm() {
  end_segments(protocol::SegmentOutcome::aborted, protocol::SegmentOutcome::aborted);
  if (mode_ != Mode::fault) mode_ = Mode::disarmed;
  fault_after_stop_ = false;
  if (faults_.any()) enter_fault();
}

void Drive::stop() {
  if (at_rest() || mode_ == Mode::stopping) return;
  if (mode_ == Mode::wheels) {
    mode_ = Mode::idle;  // brakes: a loop would trust wires that are just being looked for
    return;
  }
  end_segments(protocol::SegmentOutcome::aborted, protocol::SegmentOutcome::aborted);
  if (mode_ == Mode::segment) ramp_.set(to_body(geometry_, wheels_.set_points()));
  ramp_.set_target({});
  mode_ = Mode::stopping;
}

bool Drive::drive_velocity(const BodyTwist& twist) {
  if (!armed() || fault_after_stop_) return false;
  if (mode_ == Mode::segment || mode_ == Mode::wheels) stop();
  if (mode_ == Mode::idle) ramp_.set({});
  mode_ = Mode::velocity;
  ramp_.set_target(within(twist, limits_));
  velocity_deadline_us_ = deadline_us();
  return true;
}

bool Drive::drive_wheels(const WheelVoltages& voltages) {
  if (!armed() || fault_after_stop_ || (mode_ != Mode::idle && mode_ != Mode::wheels)) return false;
  mode_ = Mode::wheels;
  voltages_ = voltages;
  velocity_deadline_us_ = deadline_us();
  return true;
}

bool Drive::add_segment(const Trapezoid& profile, std::uint16_t tag) {
  if (!armed() || fault_after_stop_ || queue_.full()) return false;
  if (mode_ == Mode::velocity || mode_ == Mode::wheels) stop();
  queue_.push({profile, tag});
  return true;
}

void Drive::raise(Fault fault) {
  faults_.raise(fault, now_us_);
  enter_fault();
}

void Drive::clear_faults() {
  if (!at_rest()) return;
  faults_.clear();
  supervisor_.reset();
  if (mode_ == Mode::fault) mode_ = Mode::disarmed;
}

void Drive::enter_fault() {
  end_segments(protocol::SegmentOutcome::aborted, protocol::SegmentOutcome::aborted);
  fault_after_stop_ = false;
  mode_ = Mode::fault;
}

void Drive::end_segments(protocol::SegmentOutcome running, protocol::SegmentOutcome queued) {
  if (mode_ == Mode::segment) events_.push({running_.tag, running, now_us_});
  while (!queue_.empty()) events_.push({queue_.pop().tag, queued, now_us_});
}

bool Drive::standing() const {
  const WheelSpeeds speeds = wheels_.speeds();
  const auto slow = [](std::int32_t speed) { return speed < kStanding_umps && speed > -kStanding_umps; };
  return slow(speeds.left_umps) && slow(speeds.right_umps);
}

Drive::Wish Drive::wish() {
  if (mode_ == Mode::idle && !queue_.empty()) {
    follower_.begin_path(odometry_.pose());
    next_segment();
  }
  switch (mode_) {
    case Mode::velocity:
      return ramped();
    case Mode::segment:
      return follow();
    case Mode::stopping: {
      const Wish ramp = ramped();
      if (ramp.twist == BodyTwist{} && standing()) {
        mode_ = Mode::idle;
        if (fault_after_stop_) enter_fault();
      }
      return ramp;
    }
    default:
      return {};
  }
}

Drive::Wish Drive::ramped() {
  ramp_.advance();
  return {ramp_.value(), ramp_.acceleration()};
}

void Drive::next_segment() {
  running_ = queue_.pop();
  follower_.begin(running_.profile);
  settling_ticks_ = 0;
  settled_.reset();
  mode_ = Mode::segment;
}

Drive::Wish Drive::follow() {
  const PathFollower::Command command = follower_.advance(odometry_.pose());
  if (follower_.arrived()) {
    // A segment goes from rest to rest: the next one begins when the wheels stand at its end, or will not get
    // any closer.
    ++settling_ticks_;
    const bool rests = settled_.advance(standing() && follower_.close(), kSettled_ticks);
    if (rests || settling_ticks_ >= kSettleAtMost_ticks) {
      events_.push({running_.tag, protocol::SegmentOutcome::completed, now_us_});
      mode_ = Mode::idle;
      if (!queue_.empty()) next_segment();
    }
  }
  return {command.twist, command.acceleration};
}

Drive::Output Drive::output(const Wish& wish, const TickInput& input) {
  if (at_rest()) {
    wheels_.release();
    return {mode_ == Mode::idle ? Output::Bridge::brake : Output::Bridge::coast, {}};
  }
  if (mode_ == Mode::wheels) return {Output::Bridge::drive, wheels_.open_loop(voltages_, input.battery_mv)};
  const WheelSpeeds set_points = to_wheels(geometry_, wish.twist);
  const WheelSpeeds accelerations = to_wheels(geometry_, wish.acceleration);
  return {Output::Bridge::drive, wheels_.control(set_points, accelerations, input.battery_mv)};
}

}  // namespace astro
