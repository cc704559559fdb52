#include "firmware/app/tick/drive.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

// Scales both components by one factor, so that a command beyond the limits keeps its curvature. The leading one is then its limit
// exactly, so that one division is enough.
[[gnu::noinline]] BodyTwist reduced(const BodyTwist& twist, const MotionLimits& limits) {
  const std::int64_t v = magnitude(twist.v_umps);
  const std::int64_t omega = magnitude(twist.omega_uradps);
  if (v * limits.yaw_rate_uradps >= omega * limits.speed_umps)
    return {twist.v_umps < 0 ? -limits.speed_umps : limits.speed_umps,
            static_cast<std::int32_t>(std::int64_t{twist.omega_uradps} * limits.speed_umps / v)};
  return {static_cast<std::int32_t>(std::int64_t{twist.v_umps} * limits.yaw_rate_uradps / omega),
          twist.omega_uradps < 0 ? -limits.yaw_rate_uradps : limits.yaw_rate_uradps};
}

BodyTwist within_limits(const BodyTwist& twist, const MotionLimits& limits) {
  if (!exceeds(twist.v_umps, limits.speed_umps) && !exceeds(twist.omega_uradps, limits.yaw_rate_uradps))
      [[likely]]
    return twist;
  return reduced(twist, limits);
}

}  // namespace

Drive::Configuration::Configuration(const ParameterSet& parameters)
    : wheels(parameters, make_geometry(parameters)),
      limits(make_limits(parameters)),
      rates(limits),
      thresholds(parameters),
      set(parameters) {}

void Drive::configure(const Configuration& configuration) {
  geometry_ = configuration.wheels.geometry;
  limits_ = configuration.limits;
  ramp_.set_rates(configuration.rates);
  odometry_.set_geometry(geometry_);
  wheels_.configure(configuration.wheels);
  path_.set_gains(configuration.set);
  supervisor_.configure(configuration.thresholds);
}

Drive::Output Drive::advance(const TickInput& input) {
  now_us_ = input.now_us;
  phase_ = phase_ + 1 < kPhases ? phase_ + 1 : 0;
  const Wheels::Steps steps = wheels_.read(input);
  odometry_.advance(steps.left, steps.right, wheels_.speeds());
  const State before = state();
  supervisor_.advance(input, steps.plausible, steering_, wheels_);
  if (state() != before) [[unlikely]]
    follow_state();
  return output(set_point(), input);
}

protocol::Mode Drive::mode_of(const Manner& manner) {
  switch (manner.state) {
    case State::boot:
      return Mode::boot;
    case State::disarmed:
      return Mode::disarmed;
    case State::armed:
      return manner.paused ? Mode::paused : Mode::idle;
    case State::driving:
      return manner.steering == Steering::path        ? Mode::segment
             : manner.steering == Steering::open_loop ? Mode::wheels
                                                      : Mode::velocity;
    case State::stopping:
      return Mode::stopping;
    default:
      return Mode::fault;
  }
}

// ---- what a change of state entails, whoever caused it

void Drive::follow_state() {
  switch (state()) {
    case State::stopping:
      return begin_ramp();
    case State::armed:
      steering_ = Steering::none;
      return;
    case State::driving:
      return;
    default:
      end_steering();
  }
}

// The ramp starts without acceleration, so a ramp that was still going up goes down at once.
BodyTwist Drive::start_of_ramp() const {
  return steering_ == Steering::path ? to_body(geometry_, wheels_.set_points()) : ramp_.value();
}

void Drive::begin_ramp() {
  ramp_.set(start_of_ramp());
  ramp_.set_target({});
  end_steering();
}

void Drive::end_steering() {
  end_segments();
  steering_ = Steering::none;
  paused_ = false;
}

// ---- requests

void Drive::disarm() {
  supervisor_.request(Event::disarm);
  follow_state();
}

void Drive::raise(Fault fault) {
  supervisor_.raise(fault);
  follow_state();
}

bool Drive::request_stop() {
  if (state() == State::driving) {
    // No ramp in open loop: a ramp needs the control loop, which would trust wires that are just being tested.
    return supervisor_.request(steering_ == Steering::open_loop ? Event::rest : Event::stop);
  }
  end_segments();
  paused_ = false;
  return false;
}

void Drive::stop() {
  if (request_stop()) follow_state();
}

TwistRamp Drive::ramp_to_rest() const {
  TwistRamp ramp = ramp_;
  ramp.set(start_of_ramp());
  return ramp;
}

void Drive::stop(const TwistRamp& planned) {
  if (!request_stop()) return;
  if (state() != State::stopping) return follow_state();
  ramp_ = planned;
  end_steering();
}

bool Drive::arm() {
  if (!supervisor_.request(Event::arm)) return false;
  // A pause without a path has nothing that waits for its end. The robot would take segments and not move.
  if (!on_path() && path_.waiting() == 0) paused_ = false;
  return true;
}

bool Drive::pause() {
  if (!armed()) return false;
  if (on_path()) {
    path_.cut_short();
  } else if (state() == State::driving) {
    stop();
  }
  paused_ = true;
  return true;
}

// If not, a ramp is already under way and continues from its present value.
bool Drive::begins_ramp() const {
  return state() == State::armed || steering_ == Steering::open_loop || on_path();
}

TwistRamp Drive::ramp_from_here() const {
  TwistRamp ramp = ramp_;
  if (on_path()) {
    ramp.set(to_body(geometry_, wheels_.set_points()));
  } else if (begins_ramp()) {
    ramp.set(wheels_.stopped() ? BodyTwist{} : within_limits(twist(), limits_));
  }
  return ramp;
}

void Drive::aim(TwistRamp& ramp, const BodyTwist& twist, const MotionLimits& limits) {
  ramp.set_target(within_limits(twist, limits));
}

bool Drive::drive_velocity(const BodyTwist& twist) {
  TwistRamp ramp = ramp_from_here();
  aim(ramp, twist, limits_);
  return drive_velocity(ramp);
}

bool Drive::drive_velocity(const TwistRamp& planned) {
  const bool begins = begins_ramp();
  if (!supervisor_.request(Event::drive)) return false;
  supervisor_.command_seen();
  if (begins) {
    ramp_ = planned;
  } else {
    ramp_.take_target(planned);
  }
  end_segments();
  paused_ = false;
  steering_ = Steering::repeated;
  return true;
}

bool Drive::drive_wheels(const WheelVoltages& voltages) {
  if (gives_power() && steering_ != Steering::open_loop) return false;
  if (!supervisor_.request(Event::drive)) return false;
  supervisor_.command_seen();
  end_segments();
  paused_ = false;
  steering_ = Steering::open_loop;
  voltages_ = voltages;
  return true;
}

bool Drive::add_segment(const Segment& segment, std::uint16_t tag) {
  if (!armed() || faults().any() || queue_full()) return false;
  if (steering_ == Steering::repeated || steering_ == Steering::open_loop) stop();
  path_.add(segment, tag);
  return true;
}

// ---- segments

void Drive::plan() {
  Segment segment;
  std::uint8_t ticket = 0;
  if (!wants_plan(segment, ticket)) return;
  Trapezoid profile;  // stays empty, and so ends at once, if no profile fits the limits any more
  Trapezoid::plan(segment, limits_, profile);
  take_plan(profile, ticket);
}

void Drive::end_segments() {
  if (steering_ == Steering::path) {
    path_.abort(now_us_);
    steering_ = Steering::none;
  }
  path_.drop_waiting(now_us_);
}

void Drive::drop_waiting() {
  if (armed() && !faults().any()) path_.drop_waiting(now_us_);
}

bool Drive::start_path() {
  if (!supervisor_.request(Event::drive)) return false;
  steering_ = Steering::path;
  path_.begin_at(odometry_.pose(), now_us_);
  return true;
}

void Drive::end_segment() {
  path_.end(now_us_);
  if (!paused_ && path_.ready()) return path_.begin_next(now_us_);
  steering_ = Steering::none;
  supervisor_.request(Event::rest);
}

Drive::SetPoint Drive::set_point() {
  switch (state()) {
    case State::armed:
      if (phase_ != kBoundaryPhase || paused_ || !path_.ready() || !start_path()) return {};
      return set_point_of_path();
    case State::driving:
      return steering_ == Steering::path ? set_point_of_path() : set_point_of_ramp();
    case State::stopping: {
      const SetPoint ramp = set_point_of_ramp();
      const bool arrived = ramp_.arrived();
      if (arrived) supervisor_.set_point_is_zero();
      // After a fault the ramp ends in the state `fault`, otherwise in `armed`.
      if (arrived && wheels_.stopped() && supervisor_.request(Event::rest)) follow_state();
      return ramp;
    }
    default:
      return {};
  }
}

Drive::SetPoint Drive::set_point_of_ramp() {
  ramp_.advance();
  return {ramp_.value(), ramp_.acceleration()};
}

Drive::SetPoint Drive::set_point_of_path() {
  const PathFollower::Command command = path_.advance(odometry_.pose(), corrects_path());
  if (path_.arrived() && path_.settled(wheels_.stopped()) && phase_ == kBoundaryPhase) end_segment();
  return {within_limits(command.twist, limits_), command.acceleration};
}

Drive::Output Drive::output(const SetPoint& set_point, const TickInput& input) {
  const Permission permission = supervisor_.permission();
  if (permission != Permission::drive) {
    wheels_.release();
    return {permission, {}};
  }
  if (steering_ == Steering::open_loop) return {permission, wheels_.open_loop(voltages_, input.battery_mv)};
  const std::int32_t half_base = half_base_30(geometry_, set_point.twist);
  const WheelSpeeds set_points = to_wheels(half_base, set_point.twist);
  const WheelSpeeds accelerations = to_wheels(half_base, set_point.acceleration);
  return {permission, wheels_.control(set_points, accelerations, input.battery_mv)};
}

}  // namespace astro
