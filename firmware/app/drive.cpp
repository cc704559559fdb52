#include "firmware/app/drive.hpp"

namespace astro {
namespace {

constexpr std::int32_t kStanding_umps = 3'000;      // slower than this is standing: about 40 counts a second
constexpr std::uint32_t kSettled_ticks = 50;        // and for so long
constexpr std::uint32_t kSettleAtMost_ticks = 700;  // a robot held by friction is as settled as it will be

// Scales both components, so that a command beyond the limits keeps its curvature.
BodyTwist within_limits(const BodyTwist& twist, const MotionLimits& limits) {
  const std::int64_t v = twist.v_umps < 0 ? -std::int64_t{twist.v_umps} : twist.v_umps;
  const std::int64_t omega = twist.omega_uradps < 0 ? -std::int64_t{twist.omega_uradps} : twist.omega_uradps;
  const bool v_leads = v * limits.yaw_rate_uradps >= omega * limits.speed_umps;
  const std::int64_t wanted = v_leads ? v : omega;
  const std::int64_t most = v_leads ? limits.speed_umps : limits.yaw_rate_uradps;
  if (wanted <= most) return twist;
  return {static_cast<std::int32_t>(twist.v_umps * most / wanted),
          static_cast<std::int32_t>(twist.omega_uradps * most / wanted)};
}

// Somebody has carried the robot away from where its path goes on, or turned it.
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
  odometry_.advance(steps.left, steps.right);
  supervisor_.advance(input, steps.plausible, steering_, wheels_);
  if (state() != seen_) follow_state();
  return output(wish(), input);
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

// ---- what follows from a change of state, whoever made it

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
      end_segments();
      steering_ = Steering::none;
      paused_ = false;
  }
}

void Drive::begin_ramp() {
  // From here at a steady velocity: a ramp that was still going up goes down at once.
  ramp_.set(steering_ == Steering::path ? to_body(geometry_, wheels_.set_points()) : ramp_.value());
  ramp_.set_target({});
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

void Drive::stop() {
  if (state() != State::driving) {
    end_segments();
    paused_ = false;
    return;
  }
  // Open loop there is no ramp: a loop would trust wires that are just being looked for.
  supervisor_.request(steering_ == Steering::open_loop ? Event::rest : Event::stop);
  follow_state();
}

bool Drive::pause() {
  if (!armed() || (driving() && !on_path())) return false;
  paused_ = true;
  if (on_path()) follower_.cut_short();
  return true;
}

// Otherwise a ramp is under way and goes on from where it is.
bool Drive::begins_ramp() const {
  return state() == State::armed || steering_ == Steering::open_loop || on_path();
}

TwistRamp Drive::ramp_from_here() const {
  TwistRamp ramp = ramp_;
  if (on_path()) {
    ramp.set(to_body(geometry_, wheels_.set_points()));
  } else if (begins_ramp()) {
    ramp.set(standing() ? BodyTwist{} : within_limits(twist(), limits_));
  }
  return ramp;
}

void Drive::aim(TwistRamp& ramp, const BodyTwist& twist) const {
  ramp.set_target(within_limits(twist, limits_));
}

bool Drive::drive_velocity(const BodyTwist& twist) {
  TwistRamp ramp = ramp_from_here();
  aim(ramp, twist);
  return drive_velocity(ramp);
}

bool Drive::drive_velocity(const TwistRamp& planned) {
  const bool begins = begins_ramp();
  if (!supervisor_.request(Event::drive)) return false;
  supervisor_.steered();
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
  if (driving() && steering_ != Steering::open_loop) return false;
  if (!supervisor_.request(Event::drive)) return false;
  supervisor_.steered();
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
  Trapezoid profile;  // empty, and so done at once, where limits have changed beyond what can be planned
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

bool Drive::standing() const {
  const WheelSpeeds speeds = wheels_.speeds();
  return !exceeds(speeds.left_umps, kStanding_umps) && !exceeds(speeds.right_umps, kStanding_umps);
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

// What a pause has left of the segment comes first when the robot goes on.
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

Drive::Wish Drive::wish() {
  if (state() == State::armed && planned_ && !paused_) start_path();
  switch (state()) {
    case State::driving:
      return steering_ == Steering::path ? follow() : ramped();
    case State::stopping: {
      const Wish ramp = ramped();
      if (ramp_.arrived()) supervisor_.set_point_at_rest();
      if (ramp_.arrived() && standing()) {
        supervisor_.request(Event::rest);
        seen_ = State::stopping;  // so that the next tick follows
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

Drive::Wish Drive::follow() {
  const PathFollower::Command command = follower_.advance(odometry_.pose());
  if (follower_.arrived()) {
    // A segment goes from rest to rest: the next one begins when the wheels stand at its end, or will not get
    // any closer.
    ++settling_ticks_;
    const bool rests = settled_.advance(standing() && follower_.close(), kSettled_ticks);
    if (rests || settling_ticks_ >= kSettleAtMost_ticks) end_segment();
  }
  return {within_limits(command.twist, limits_), command.acceleration};
}

Drive::Output Drive::output(const Wish& wish, const TickInput& input) {
  const Permission permission = supervisor_.permission();
  if (permission != Permission::drive) {
    wheels_.release();
    return {permission, {}};
  }
  if (steering_ == Steering::open_loop) return {permission, wheels_.open_loop(voltages_, input.battery_mv)};
  const WheelSpeeds set_points = to_wheels(geometry_, wish.twist);
  const WheelSpeeds accelerations = to_wheels(geometry_, wish.acceleration);
  return {permission, wheels_.control(set_points, accelerations, input.battery_mv)};
}

}  // namespace astro
