#include "firmware/app/supervisor.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

constexpr std::int32_t kPulls = 32767 / 2;    // of full duty
constexpr std::int32_t kStands_umps = 2'000;  // 25 counts a second
constexpr std::int32_t kTurns_umps = 50'000;  // no longer noise, nor a gear's play
constexpr std::uint32_t kDither_edges = 4;    // in 16 ms: a wheel that is held makes one or two
constexpr std::uint8_t kGoodRounds = 4;       // 32 ticks on time

constexpr std::uint32_t visits(std::uint32_t ms) { return (ms + kWatchPeriod_ms - 1) / kWatchPeriod_ms; }
template <Fault F>
constexpr std::uint32_t kVisits = visits(rule(F).hold_ms);

}  // namespace

void Supervisor::configure(const ParameterSet& set) {
  battery_low_mv_ = set.get(Param::battery_low);
  const std::int32_t high_mv = set.get(Param::battery_high);
  battery_high_mv_ = high_mv != 0 ? high_mv : INT32_MAX;
  over_speed_umps_ = set.get(Param::over_speed);
  stall_visits_ = visits(static_cast<std::uint32_t>(set.get(Param::stall_time)));
  command_timeout_us_ = static_cast<std::uint32_t>(set.get(Param::command_timeout)) * 1000;
}

bool Supervisor::request(Event event) {
  const bool gives_power = event == Event::arm || event == Event::drive;
  if (gives_power && faults_.any()) return false;
  if (!astro::advance(state_, event)) return false;
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

void Supervisor::found(Fault fault) {
  if (rule(fault).reaction == Reaction::off || state_ != State::driving) return raise(fault);
  faults_.raise(fault, now_us_);
  astro::advance(state_, Event::stop);
  ramp_deadline_us_ = now_us_ + kRampAtMost_ms * 1000;
}

void Supervisor::advance(const TickInput& input, bool plausible, Steering steering, const Wheels& wheels) {
  now_us_ = input.now_us;
  if (!plausible) [[unlikely]]
    raise(Fault::encoder);
  if (input.driver_fault && watched_in(Fault::driver)) [[unlikely]]
    raise(Fault::driver);
  if (!input.on_time) [[unlikely]] {
    good_rounds_ = 0;
    if (watched_in(Fault::tick_overrun)) raise(Fault::tick_overrun);
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
      return look_for_stall(left_.stall, wheels.forward_duty().left, wheels.speeds().left_umps);
    case 3:
      return look_for_stall(right_.stall, wheels.forward_duty().right, wheels.speeds().right_umps);
    case 4:
      return look_for_runaway(left_.runaway, wheels.forward_duty().left, wheels.speeds().left_umps, steering);
    case 5:
      return look_for_runaway(right_.runaway, wheels.forward_duty().right, wheels.speeds().right_umps,
                              steering);
    case 6:
      if (!proven_) look_at_boot();
      return look_at_deadlines(steering);
    default:
      return turn_ < kWatchPeriod_ms ? look_for_dither(left_, wheels.forward_duty().left,
                                                       wheels.left_counts(), wheels.left_edges())
                                     : look_for_dither(right_, wheels.forward_duty().right,
                                                       wheels.right_counts(), wheels.right_edges());
  }
}

void Supervisor::look_at_supply(std::int32_t battery_mv) {
  if (over_voltage_.advance(battery_mv > battery_high_mv_, kVisits<Fault::over_voltage>))
    found(Fault::over_voltage);
  const bool low = battery_mv < battery_low_mv_ && watched_in(Fault::under_voltage);
  if (under_voltage_.advance(low, kVisits<Fault::under_voltage>)) found(Fault::under_voltage);
}

void Supervisor::look_at_speed(const WheelSpeeds& speeds) {
  const bool fast =
      exceeds(speeds.left_umps, over_speed_umps_) || exceeds(speeds.right_umps, over_speed_umps_);
  if (over_speed_.advance(fast, kVisits<Fault::over_speed>)) found(Fault::over_speed);
}

void Supervisor::look_for_stall(Watch& watch, std::int32_t duty, std::int32_t speed_umps) {
  const bool stands = exceeds(duty, kPulls) && !exceeds(speed_umps, kStands_umps) && watched_in(Fault::stall);
  if (watch.advance(stands, stall_visits_)) found(Fault::stall);
}

void Supervisor::look_for_runaway(Watch& watch, std::int32_t duty, std::int32_t speed_umps,
                                  Steering steering) {
  // Without a loop a reversed wheel is just a reversed wheel.
  const bool against = (duty ^ speed_umps) < 0 && exceeds(duty, kPulls) && exceeds(speed_umps, kTurns_umps) &&
                       steering != Steering::open_loop && watched_in(Fault::runaway);
  if (watch.advance(against, kVisits<Fault::runaway>)) found(Fault::runaway);
}

void Supervisor::look_for_dither(WheelWatch& watch, std::int32_t duty, std::int32_t counts,
                                 std::uint32_t edges) {
  // Counts, but no way: not more than the one that a single channel makes.
  const std::uint32_t way = static_cast<std::uint32_t>(counts) - watch.counts, made = edges - watch.edges;
  watch.counts = static_cast<std::uint32_t>(counts);
  watch.edges = edges;
  const bool to_and_fro =
      way + 1 <= 2 && made >= kDither_edges && exceeds(duty, kPulls) && watched_in(Fault::stall);
  if (watch.dither.advance(to_and_fro, kVisits<Fault::encoder> / 2)) found(Fault::encoder);
}

void Supervisor::look_at_deadlines(Steering steering) {
  if (state_ == State::stopping && faults_.any() && now_us_ >= ramp_deadline_us_)
    astro::advance(state_, Event::fault);
  if (state_ != State::driving) return;
  const std::uint64_t silent_us = now_us_ - (steering == Steering::path ? host_seen_at_us_ : steered_at_us_);
  if (command_timeout_us_ == 0 || silent_us <= command_timeout_us_) return;
  if (steering == Steering::open_loop) return raise(Fault::command_timeout);  // no loop, no ramp
  found(steering == Steering::path ? Fault::link_lost : Fault::command_timeout);
}

void Supervisor::look_at_boot() {
  if (++good_rounds_ < kGoodRounds) return;
  proven_ = true;
  astro::advance(state_, Event::proven);
}

}  // namespace astro
