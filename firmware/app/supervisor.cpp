#include "firmware/app/supervisor.hpp"

#include <algorithm>

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

constexpr std::int32_t kStands_umps = 2'000;  // 25 counts a second
constexpr std::int32_t kTurns_umps = 50'000;  // no longer noise, nor a gear's play
constexpr std::uint32_t kDither_edges = 4;    // in 16 ms: a wheel that is held makes one or two
constexpr std::uint8_t kGoodRounds = 4;       // 32 ticks on time

constexpr std::uint32_t visits(std::uint32_t ms) { return (ms + kWatchPeriod_ms - 1) / kWatchPeriod_ms; }
constexpr std::uint32_t kSilentVisits = visits(kSilence_ms);
template <Check C>
constexpr std::uint32_t kVisits = visits(rule(C).hold_ms);

// How long the set point takes from the fastest speed to zero: at the steepest acceleration, which the jerk
// limit reaches and leaves within half a second each (TwistRamp).
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
      armed_visits(std::max(timeout_visits, kSilentVisits)),
      longest_ramp_us(::astro::longest_ramp_us(set) + rule(Check::stop_timeout).hold_ms * 1000U) {
  if (battery_high_mv == 0) battery_high_mv = INT32_MAX;
  if (timeout_visits == 0) timeout_visits = armed_visits = UINT32_MAX;
}

bool Supervisor::request(Event event) {
  const bool gives_power = event == Event::arm || event == Event::drive;
  if (gives_power && faults_.any()) return false;
  const State before = state_;
  if (!astro::advance(state_, event)) return false;
  if (state_ == State::stopping && before != State::stopping) begin_ramp();
  if (event == Event::arm) host_seen();
  // The ramp of a fault has ended, or somebody has ended it.
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

void Supervisor::set_point_at_rest() {
  rest_deadline_us_ = std::min(rest_deadline_us_, now_us_ + rule(Check::stop_timeout).hold_ms * 1000U);
}

void Supervisor::found(Check check) {
  const FaultRule& found = rule(check);
  if (found.reaction == Reaction::off || state_ != State::driving) return raise(found.fault);
  faults_.raise(found.fault, now_us_);
  astro::advance(state_, Event::stop);
  begin_ramp();
  ramp_deadline_us_ = now_us_ + kRampAtMost_ms * 1000U;
}

void Supervisor::advance(const TickInput& input, bool plausible, Steering steering, const Wheels& wheels) {
  now_us_ = input.now_us;
  if (!plausible && watched_in(Check::encoder_jump)) [[unlikely]]
    found(Check::encoder_jump);
  if (input.driver_fault && watched_in(Check::driver)) [[unlikely]]
    found(Check::driver);
  if (!input.on_time) [[unlikely]] {
    good_rounds_ = 0;
    if (watched_in(Check::tick_overrun)) found(Check::tick_overrun);
  }
  look(input, steering, wheels);
  watched_ = true;
}

void Supervisor::look(const TickInput& input, Steering steering, const Wheels& wheels) {
  turn_ = (turn_ + 1) % (2 * kWatchPeriod_ms);
  switch (turn_ % kWatchPeriod_ms) {
    case 0:
      return look_at_supply(input.battery_mv);
    case 1:
      return look_at_speed(wheels.speeds());
    case 2:
      look_at_ramp();
      return look_for_stall(left_.stall, wheels.forward_duty().left, wheels.speeds().left_umps);
    case 3:
      pulling_duty_ = wheels.half_duty(input.battery_mv);
      return look_for_stall(right_.stall, wheels.forward_duty().right, wheels.speeds().right_umps);
    case 4:
      return look_for_runaway(left_.runaway, wheels.forward_duty().left, wheels.speeds().left_umps, steering);
    case 5:
      return look_for_runaway(right_.runaway, wheels.forward_duty().right, wheels.speeds().right_umps,
                              steering);
    case 6:
      if (!proven_) look_at_boot();
      return look_for_host(steering);
    default:
      return turn_ < kWatchPeriod_ms ? look_for_lost_channel(left_, wheels.forward_duty().left,
                                                             wheels.left_counts(), wheels.left_edges())
                                     : look_for_lost_channel(right_, wheels.forward_duty().right,
                                                             wheels.right_counts(), wheels.right_edges());
  }
}

void Supervisor::look_at_supply(std::int32_t battery_mv) {
  const bool high = battery_mv > thresholds_.battery_high_mv && watched_in(Check::over_voltage);
  if (over_voltage_.advance(high, kVisits<Check::over_voltage>)) found(Check::over_voltage);
  const bool low = battery_mv < thresholds_.battery_low_mv && watched_in(Check::under_voltage);
  if (under_voltage_.advance(low, kVisits<Check::under_voltage>)) found(Check::under_voltage);
}

void Supervisor::look_at_speed(const WheelSpeeds& speeds) {
  const bool fast = exceeds(speeds.left_umps, thresholds_.over_speed_umps) ||
                    exceeds(speeds.right_umps, thresholds_.over_speed_umps);
  if (over_speed_.advance(fast && watched_in(Check::over_speed), kVisits<Check::over_speed>))
    found(Check::over_speed);
}

void Supervisor::look_for_stall(Watch& watch, std::int32_t duty, std::int32_t speed_umps) {
  const bool stands = pulls(duty) && !exceeds(speed_umps, kStands_umps) && watched_in(Check::stall);
  if (watch.advance(stands, thresholds_.stall_visits)) found(Check::stall);
}

void Supervisor::look_for_runaway(Watch& watch, std::int32_t duty, std::int32_t speed_umps,
                                  Steering steering) {
  // Without a loop a reversed wheel is just a reversed wheel.
  const bool against = (duty ^ speed_umps) < 0 && pulls(duty) && exceeds(speed_umps, kTurns_umps) &&
                       steering != Steering::open_loop && watched_in(Check::runaway);
  if (watch.advance(against, kVisits<Check::runaway>)) found(Check::runaway);
}

void Supervisor::look_for_lost_channel(WheelWatch& watch, std::int32_t duty, std::int32_t counts,
                                       std::uint32_t edges) {
  // Counts, but no travel: not more than the one count that a single channel makes.
  const std::uint32_t travel = static_cast<std::uint32_t>(counts) - watch.counts, made = edges - watch.edges;
  watch.counts = static_cast<std::uint32_t>(counts);
  watch.edges = edges;
  const bool to_and_fro =
      travel + 1 <= 2 && made >= kDither_edges && pulls(duty) && watched_in(Check::encoder_channel);
  if (watch.lost_channel.advance(to_and_fro, kVisits<Check::encoder_channel> / 2))
    found(Check::encoder_channel);
}

// While the robot stops or stands its host has nothing to repeat, and may wait a little longer.
std::uint32_t Supervisor::visits_allowed() const {
  if (state_ == State::driving) return thresholds_.timeout_visits;
  return state_ == State::stopping ? kSilentVisits : thresholds_.armed_visits;
}

void Supervisor::look_at_ramp() {
  if (state_ != State::stopping) return;
  if (watched_in(Check::stop_timeout) && now_us_ >= rest_deadline_us_) return found(Check::stop_timeout);
  if (faults_.any() && now_us_ >= ramp_deadline_us_) astro::advance(state_, Event::fault);
}

void Supervisor::look_for_host(Steering steering) {
  const bool repeats = state_ == State::driving && steering != Steering::path;
  const std::uint32_t steered = ++steered_visits_, seen = ++host_visits_;
  if ((repeats ? steered : seen) <= visits_allowed()) [[likely]]
    return;
  const Check check = repeats ? Check::command_timeout : Check::link_lost;
  if (!watched_in(check)) return;
  if (state_ == State::stopping && faults_.any()) return;                // a silent host is no further fault
  if (steering == Steering::open_loop) return raise(rule(check).fault);  // no loop, no ramp
  found(check);
}

void Supervisor::look_at_boot() {
  if (++good_rounds_ < kGoodRounds) return;
  proven_ = true;
  astro::advance(state_, Event::proven);
}

}  // namespace astro
