#include "firmware/app/tick/supervisor.hpp"

#include <algorithm>

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

constexpr std::int32_t kTurns_umps = 50'000;  // more than noise or a gear's backlash make
constexpr std::uint32_t kDither_edges = 4;    // in 16 ms: a wheel that is held in place makes one or two
constexpr std::uint8_t kGoodRounds = 4;       // 32 ticks on time

constexpr std::uint32_t visits(std::uint32_t ms) { return (ms + kWatchPeriod_ms - 1) / kWatchPeriod_ms; }
template <Check C>
constexpr std::uint32_t kVisits = visits(rule(C).hold_ms);

// How long the set point takes from the fastest speed to zero: at full deceleration, plus at most half a
// second each for the jerk limit to reach it and to leave it (TwistRamp).
std::uint64_t longest_ramp_us(const ParameterSet& set) {
  constexpr std::uint64_t kJerk_us = 1'000'000;
  const auto time_us = [&](Param speed, Param acceleration) {
    return std::int64_t{set.get(speed)} * 1'000'000 / std::max<std::int32_t>(set.get(acceleration), 1);
  };
  return kJerk_us +
         static_cast<std::uint64_t>(std::max(time_us(Param::speed_limit, Param::acceleration_limit),
                                             time_us(Param::yaw_rate_limit, Param::yaw_acceleration_limit)));
}

}  // namespace

Supervisor::Thresholds::Thresholds(const ParameterSet& set)
    : battery_low_mv(set.get(Param::battery_low)),
      battery_high_mv(set.get(Param::battery_high)),
      over_speed_umps(set.get(Param::over_speed)),
      stall_visits(visits(static_cast<std::uint32_t>(set.get(Param::stall_time)))),
      timeout_visits(visits(static_cast<std::uint32_t>(set.get(Param::command_timeout)))),
      armed_visits(std::max(timeout_visits, kVisits<Check::armed_host_lost>)),
      longest_ramp_us(::astro::longest_ramp_us(set) + rule(Check::stop_timeout).hold_ms * 1000U) {
  if (battery_high_mv == 0) battery_high_mv = INT32_MAX;
  if (timeout_visits == 0) timeout_visits = armed_visits = UINT32_MAX;
}

bool Supervisor::request(Event event) {
  const bool gives_power = event == Event::arm || event == Event::drive;
  if (gives_power && faults_.any()) return false;
  const State before = state_;
  if (!astro::advance(state_, event)) return false;
  const bool begins_to_stop = state_ == State::stopping && before != State::stopping;
  if (begins_to_stop) begin_ramp();
  // The host that asks is there, whether it is the one that drove or another.
  if (begins_to_stop || event == Event::arm) host_seen();
  // The ramp after a fault has ended by itself or by a request.
  if (faults_.any() && (state_ == State::armed || state_ == State::disarmed)) state_ = State::fault;
  return true;
}

void Supervisor::raise(Fault fault) {
  faults_.raise(fault, now_us_);
  astro::advance(state_, Event::fault);
}

bool Supervisor::clear() {
  if (!astro::advance(state_, Event::clear)) return false;
  faults_.clear();
  under_voltage_.reset();
  over_voltage_.reset();
  over_speed_.reset();
  left_ = right_ = {};
  if (!proven_) state_ = State::boot;
  return true;
}

void Supervisor::begin_ramp() {
  ramp_deadline_us_ = kNever_us;
  rest_deadline_us_ = now_us_ + thresholds_.longest_ramp_us;
}

void Supervisor::set_point_is_zero() {
  rest_deadline_us_ = std::min(rest_deadline_us_, now_us_ + rule(Check::stop_timeout).hold_ms * 1000U);
}

void Supervisor::react(Check check) {
  const FaultRule& broken = rule(check);
  if (broken.reaction == Reaction::off) return raise(broken.fault);
  faults_.raise(broken.fault, now_us_);
  astro::advance(state_, Event::stop);
  begin_ramp();
  ramp_deadline_us_ = now_us_ + kRampAtMost_ms * 1000U;
}

void Supervisor::advance(const TickInput& input, bool plausible, Steering steering, const Wheels& wheels) {
  now_us_ = input.now_us;
  if (!plausible && made_now(Check::encoder_jump)) [[unlikely]]
    react(Check::encoder_jump);
  if (input.driver_fault && made_now(Check::driver)) [[unlikely]]
    react(Check::driver);
  if (!input.on_time) [[unlikely]] {
    good_rounds_ = 0;
    if (made_now(Check::tick_overrun)) react(Check::tick_overrun);
  }
  make_slow_check(input, steering, wheels);
  checked_ = true;
}

void Supervisor::make_slow_check(const TickInput& input, Steering steering, const Wheels& wheels) {
  turn_ = (turn_ + 1) % (2 * kWatchPeriod_ms);
  switch (turn_ % kWatchPeriod_ms) {
    case 0:
      return check_supply(input.battery_mv);
    case 1:
      return check_speed(wheels.speeds());
    case 2:
      check_ramp();
      return check_stall(left_.stall, wheels.forward_duty().left, wheels.speeds().left_umps);
    case 3:
      pulling_duty_ = wheels.half_duty(input.battery_mv);
      return check_stall(right_.stall, wheels.forward_duty().right, wheels.speeds().right_umps);
    case 4:
      return check_runaway(left_.runaway, wheels.forward_duty().left, wheels.speeds().left_umps, steering);
    case 5:
      return check_runaway(right_.runaway, wheels.forward_duty().right, wheels.speeds().right_umps, steering);
    case 6:
      if (!proven_) check_boot();
      return check_host(steering);
    default:
      return turn_ < kWatchPeriod_ms ? check_channels(left_, wheels.forward_duty().left, wheels.left_counts(),
                                                      wheels.left_edges())
                                     : check_channels(right_, wheels.forward_duty().right,
                                                      wheels.right_counts(), wheels.right_edges());
  }
}

void Supervisor::check_supply(std::int32_t battery_mv) {
  const bool high = battery_mv > thresholds_.battery_high_mv && made_now(Check::over_voltage);
  if (over_voltage_.advance(high, kVisits<Check::over_voltage>)) react(Check::over_voltage);
  const bool low = battery_mv < thresholds_.battery_low_mv && made_now(Check::under_voltage);
  if (under_voltage_.advance(low, kVisits<Check::under_voltage>)) react(Check::under_voltage);
}

void Supervisor::check_speed(const WheelSpeeds& speeds) {
  const bool fast = exceeds(speeds.left_umps, thresholds_.over_speed_umps) ||
                    exceeds(speeds.right_umps, thresholds_.over_speed_umps);
  if (over_speed_.advance(fast && made_now(Check::over_speed), kVisits<Check::over_speed>))
    react(Check::over_speed);
}

void Supervisor::check_stall(Watch& watch, std::int32_t duty, std::int32_t speed_umps) {
  const bool stalls = pulls(duty) && wheel_stopped(speed_umps) && made_now(Check::stall);
  if (watch.advance(stalls, thresholds_.stall_visits)) react(Check::stall);
}

void Supervisor::check_runaway(Watch& watch, std::int32_t duty, std::int32_t speed_umps, Steering steering) {
  // In open loop a reversed wheel does no harm, so it is no fault.
  const bool against = (duty ^ speed_umps) < 0 && pulls(duty) && exceeds(speed_umps, kTurns_umps) &&
                       steering != Steering::open_loop && made_now(Check::runaway);
  if (watch.advance(against, kVisits<Check::runaway>)) react(Check::runaway);
}

void Supervisor::check_channels(WheelWatch& watch, std::int32_t duty, std::int32_t counts,
                                std::uint32_t edges) {
  // Counts without travel: at most the one count to and fro that a single channel makes.
  const std::uint32_t travel = static_cast<std::uint32_t>(counts) - watch.counts, made = edges - watch.edges;
  watch.counts = static_cast<std::uint32_t>(counts);
  watch.edges = edges;
  const bool to_and_fro =
      travel + 1 <= 2 && made >= kDither_edges && pulls(duty) && made_now(Check::encoder_channel);
  if (watch.lost_channel.advance(to_and_fro, kVisits<Check::encoder_channel> / 2))
    react(Check::encoder_channel);
}

// While the robot stops or stands the host has nothing to repeat, so it may be silent a little longer.
std::uint32_t Supervisor::visits_allowed() const {
  if (state_ == State::driving) return thresholds_.timeout_visits;
  return state_ == State::stopping ? kVisits<Check::stopping_host_lost> : thresholds_.armed_visits;
}

void Supervisor::check_ramp() {
  if (state_ != State::stopping) return;
  if (made_now(Check::stop_timeout) && now_us_ >= rest_deadline_us_) return react(Check::stop_timeout);
  if (faults_.any() && now_us_ >= ramp_deadline_us_) astro::advance(state_, Event::fault);
}

void Supervisor::check_host(Steering steering) {
  const bool must_repeat = state_ == State::driving && steering != Steering::path;
  const std::uint32_t command = ++command_visits_, host = ++host_visits_;
  if ((must_repeat ? command : host) <= visits_allowed()) [[likely]]
    return;
  if (state_ == State::stopping && faults_.any()) return;  // its ramp ends anyway: no second fault
  const Check check = host_check(steering);
  if (made_now(check)) react(check);
}

Check Supervisor::host_check(Steering steering) const {
  if (state_ == State::stopping) return Check::stopping_host_lost;
  if (state_ != State::driving) return Check::armed_host_lost;
  if (steering == Steering::path) return Check::path_host_lost;
  return steering == Steering::open_loop ? Check::open_loop_timeout : Check::command_timeout;
}

void Supervisor::check_boot() {
  if (++good_rounds_ < kGoodRounds) return;
  proven_ = true;
  astro::advance(state_, Event::proven);
}

}  // namespace astro
