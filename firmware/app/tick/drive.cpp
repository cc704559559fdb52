#include "firmware/app/tick/drive.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

constexpr std::uint32_t kSettled_ticks = 50;        // stopped and close to the path's end for so long
constexpr std::uint32_t kSettleAtMost_ticks = 700;  // a robot held by friction will not get any closer

// Scales both components by one factor, so that a command beyond the limits keeps its curvature.
BodyTwist within_limits(const BodyTwist& twist, const MotionLimits& limits) {
  const std::int64_t v = magnitude(twist.v_umps);
  const std::int64_t omega = magnitude(twist.omega_uradps);
  const bool v_leads = v * limits.yaw_rate_uradps >= omega * limits.speed_umps;
  const std::int64_t wanted = v_leads ? v : omega;
  const std::int64_t most = v_leads ? limits.speed_umps : limits.yaw_rate_uradps;
  if (wanted <= most) return twist;
  return {static_cast<std::int32_t>(twist.v_umps * most / wanted),
          static_cast<std::int32_t>(twist.omega_uradps * most / wanted)};
}

// Somebody has carried the robot away from the point where its path continues, or turned it.
bool strayed(const Pose& reference, const Pose& actual) {
  constexpr std::int64_t kFar = (std::int64_t{1} << Pose::kPositionBits) / 20;  // 50 mm
  const std::int64_t x = reference.x - actual.x, y = reference.y - actual.y;
  constexpr std::int32_t kFar_32 = 0x0400'0000;  // 1/64 turn
  const auto turn_32 = static_cast<std::int32_t>((reference.theta - actual.theta) >> 32);
  return x > kFar || x < -kFar || y > kFar || y < -kFar || exceeds(turn_32, kFar_32);
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
  follower_.set_gains(configuration.set);
  supervisor_.configure(configuration.thresholds);
}

Drive::Output Drive::advance(const TickInput& input) {
  now_us_ = input.now_us;
  const Wheels::Steps steps = wheels_.read(input);
  odometry_.advance(steps.left, steps.right, wheels_.speeds());
  supervisor_.advance(input, steps.plausible, steering_, wheels_);
  if (state() != seen_) follow_state();
  return output(set_point(), input);
}

protocol::Mode Drive::mode() const {
  switch (state()) {
    case State::boot:
      return Mode::boot;
    case State::disarmed:
      return Mode::disarmed;
    case State::armed:
      return paused_ ? Mode::paused : Mode::idle;
    case State::driving:
      return steering_ == Steering::path        ? Mode::segment
             : steering_ == Steering::open_loop ? Mode::wheels
                                                : Mode::velocity;
    case State::stopping:
      return Mode::stopping;
    default:
      return Mode::fault;
  }
}

// ---- what a change of state entails, whoever caused it

void Drive::follow_state() {
  seen_ = state();
  switch (seen_) {
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
  state_is_followed();
}

bool Drive::arm() {
  if (!supervisor_.request(Event::arm)) return false;
  // A pause without a path has nothing that waits for its end. The robot would take segments and not move.
  if (!on_path() && queue_.empty()) paused_ = false;
  return true;
}

bool Drive::pause() {
  if (!armed()) return false;
  if (on_path()) {
    follower_.cut_short();
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
  state_is_followed();
  return true;
}

bool Drive::drive_wheels(const WheelVoltages& voltages) {
  if (gives_power() && steering_ != Steering::open_loop) return false;
  if (!supervisor_.request(Event::drive)) return false;
  supervisor_.command_seen();
  end_segments();
  paused_ = false;
  steering_ = Steering::open_loop;
  state_is_followed();
  voltages_ = voltages;
  return true;
}

bool Drive::add_segment(const Segment& segment, std::uint16_t tag) {
  if (!armed() || faults().any() || queue_full()) return false;
  if (steering_ == Steering::repeated || steering_ == Steering::open_loop) stop();
  queue_.push({segment, tag});
  return true;
}

// ---- segments

bool Drive::wants_plan(Segment& segment, std::uint8_t& ticket) const {
  if (planned_ || queue_.empty()) return false;
  segment = queue_.front().segment;
  ticket = ticket_;
  return true;
}

void Drive::take_plan(const Trapezoid& profile, std::uint8_t ticket) {
  if (ticket != ticket_ || queue_.empty()) return;
  next_ = profile;
  planned_ = true;
}

void Drive::plan() {
  Segment segment;
  std::uint8_t ticket = 0;
  if (!wants_plan(segment, ticket)) return;
  Trapezoid profile;  // stays empty, and so ends at once, if no profile fits the limits any more
  Trapezoid::plan(segment, limits_, profile);
  take_plan(profile, ticket);
}

void Drive::report(SegmentEvent::Kind kind, std::uint16_t tag) { events_.push({now_us_, tag, kind}); }

void Drive::end_segments() {
  if (steering_ == Steering::path) report(SegmentEvent::Kind::aborted, running_.tag);
  if (steering_ == Steering::path) steering_ = Steering::none;
  end_waiting();
}

void Drive::drop_waiting() {
  if (armed() && !faults().any()) end_waiting();
}

void Drive::end_waiting() {
  events_.push_all(queue_, [now_us = now_us_](const QueuedSegment& one) {
    return SegmentEvent{now_us, one.tag, SegmentEvent::Kind::aborted};
  });
  planned_ = path_open_ = false;
  ++ticket_;
}

void Drive::start_path() {
  if (!supervisor_.request(Event::drive)) return;
  state_is_followed();
  steering_ = Steering::path;
  if (!path_open_ || strayed(follower_.reference(), odometry_.pose())) follower_.begin_path(odometry_.pose());
  start_segment();
}

void Drive::start_segment() {
  running_ = queue_.pop();
  follower_.begin(next_);
  planned_ = false;
  ++ticket_;
  settling_ticks_ = 0;
  settled_.reset();
  report(SegmentEvent::Kind::started, running_.tag);
}

// After a pause the rest of the segment is driven first.
void Drive::put_back(Segment rest) {
  rest.speed_umps = running_.segment.speed_umps;
  rest.yaw_rate_uradps = running_.segment.yaw_rate_uradps;
  queue_.push_front({rest, running_.tag});
  planned_ = false;
  ++ticket_;
}

void Drive::end_segment() {
  const Segment left = follower_.profile().rest();
  if (left.length_nm != 0 || left.angle_32 != 0 || left.dwell_ms != 0) {
    put_back(left);
  } else {
    report(SegmentEvent::Kind::completed, running_.tag);
  }
  path_open_ = !queue_.empty();
  if (!paused_ && planned_) return start_segment();
  steering_ = Steering::none;
  supervisor_.request(Event::rest);
  state_is_followed();
}

Drive::SetPoint Drive::set_point() {
  if (state() == State::armed && planned_ && !paused_) start_path();
  switch (state()) {
    case State::driving:
      return steering_ == Steering::path ? set_point_of_path() : set_point_of_ramp();
    case State::stopping: {
      const SetPoint ramp = set_point_of_ramp();
      if (ramp_.arrived()) supervisor_.set_point_is_zero();
      if (ramp_.arrived() && wheels_.stopped()) {
        supervisor_.request(Event::rest);
        seen_ = State::stopping;  // so that the next tick adapts to the new state
      }
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
  const PathFollower::Command command = follower_.advance(odometry_.pose());
  if (follower_.arrived()) {
    // A segment goes from rest to rest: the next one begins when the wheels have stopped at its end, or when
    // they will not get any closer.
    ++settling_ticks_;
    const bool rests = settled_.advance(wheels_.stopped() && follower_.close(), kSettled_ticks);
    if (rests || settling_ticks_ >= kSettleAtMost_ticks) end_segment();
  }
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
