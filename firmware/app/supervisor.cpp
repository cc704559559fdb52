#include "firmware/app/supervisor.hpp"

#include "common/fixed/saturate.hpp"

namespace astro {
namespace {

constexpr std::int32_t kPulls = 32767 / 2;    // of full duty
constexpr std::int32_t kStands_umps = 2'000;  // 25 counts a second
constexpr std::int32_t kTurns_umps = 50'000;  // no longer noise, nor a gear's play
constexpr std::uint32_t kDither_edges = 16;   // a wheel that is held makes one or two
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
  if (state_ == State::armed && faults_.any()) state_ = State::fault;  // the ramp of a fault has ended
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
  turn_ = (turn_ + 1) % kWatchPeriod_ms;
  switch (turn_) {
    case 0:
      look_at_supply(input.battery_mv);
      break;
    case 1:
      look_at_speed(wheels.speeds());
      break;
    case 2:
      look_for_stall(left_, wheels.left());
      break;
    case 3:
      look_for_stall(right_, wheels.right());
      break;
    case 4:
      look_for_runaway(left_, wheels.left(), steering);
      break;
    case 5:
      look_for_runaway(right_, wheels.right(), steering);
      break;
    case 6:
      look_at_deadlines(steering);
      break;
    default:
      look_at_boot();
  }
  watched_ = true;
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

void Supervisor::look_for_stall(WheelWatch& watch, const Wheels::Motion& motion) {
  const bool stands =
      exceeds(motion.duty, kPulls) && !exceeds(motion.speed_umps, kStands_umps) && watched_in(Fault::stall);
  if (!stands) {
    watch.edges = motion.edges;
    watch.stall.reset();
    watch.dither.reset();
    return;
  }
  const bool dithers = motion.edges - watch.edges > kDither_edges;
  if (watch.dither.advance(dithers, kVisits<Fault::encoder>)) found(Fault::encoder);
  if (watch.stall.advance(!dithers, stall_visits_)) found(Fault::stall);
}

void Supervisor::look_for_runaway(WheelWatch& watch, const Wheels::Motion& motion, Steering steering) {
  // Without a loop a reversed wheel is just a reversed wheel.
  const bool against = (motion.duty ^ motion.speed_umps) < 0 && exceeds(motion.duty, kPulls) &&
                       exceeds(motion.speed_umps, kTurns_umps) && steering != Steering::open_loop &&
                       watched_in(Fault::runaway);
  if (watch.runaway.advance(against, kVisits<Fault::runaway>)) found(Fault::runaway);
}

void Supervisor::look_at_deadlines(Steering steering) {
  if (state_ == State::stopping && faults_.any() && now_us_ >= ramp_deadline_us_)
    astro::advance(state_, Event::fault);
  if (state_ != State::driving) return;
  if (now_us_ <= (steering == Steering::path ? host_deadline_us_ : steering_deadline_us_)) return;
  if (steering == Steering::open_loop) return raise(Fault::command_timeout);  // no loop, no ramp
  found(steering == Steering::path ? Fault::link_lost : Fault::command_timeout);
}

void Supervisor::look_at_boot() {
  if (proven_ || ++good_rounds_ < kGoodRounds) return;
  proven_ = true;
  astro::advance(state_, Event::proven);
}

}  // namespace astro
