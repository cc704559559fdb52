#include "firmware/app/tick/gyro_heading.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "common/fixed/multiply.hpp"
#include "common/fixed/saturate.hpp"
#include "common/fixed/wrapping.hpp"

namespace astro {
namespace {

constexpr int kSilence_ticks = 25;   // five samples of the slowest gyro that is set up
constexpr int kFrozen_samples = 20;  // noise moves some axis in each of them, in a gyro that works
constexpr double kTwoPi = 6.283185307179586;
// A tick at 1e-9 rad/s, 2^-20 of 2^-48 turn.
constexpr auto kTickTurn_68 = static_cast<std::int64_t>(0x1p68 * 1e-12 / kTwoPi);
// 2^-40 turn in ten ticks to 1e-6 rad/s, 2^-32.
constexpr auto kStepRate_32 = static_cast<std::int64_t>(kTwoPi * 1e8 / 0x1p40 * 0x1p32);
// 2^-32 turn to 1e-4 rad, 2^-32.
constexpr auto kUnseen_32 = static_cast<std::int64_t>(kTwoPi * 1e4);

std::uint32_t travel_28(std::int64_t half_travel) {
  return static_cast<std::uint32_t>(std::min<std::int64_t>(half_travel >> 32, UINT32_MAX));
}

}  // namespace

GyroHeading::Configuration::Configuration(const ParameterSet& set, const Geometry& geometry)
    : filter(set, geometry),
      axis(set.get(Param::gyro_axis)),
      scale_30(set.get(Param::gyro_scale)),
      lag_ticks(set.get(Param::gyro_lag)),
      left_half_travel(geometry.left.half_travel),
      right_half_travel(geometry.right.half_travel),
      left_path_28(travel_28(geometry.left.half_travel)),
      right_path_28(travel_28(geometry.right.half_travel)),
      slip_stops(set.get(Param::gyro_slip_stops) != 0) {
  static_assert(param_row(Param::gyro_lag).exponent == -3 && kTickHz == 1000, "the lag is in ticks");
  static_assert(param_row(Param::gyro_lag).maximum_raw <= (static_cast<std::int32_t>(kHistory) - 2) * kTicks);
}

void GyroHeading::configure(const Configuration& configuration, const Drive& drive) {
  const bool begins = configuration.axis != axis_ || configuration.scale_30 != scale_30_ ||
                      configuration.lag_ticks != lag_ticks_;
  filter_.configure(configuration.filter);
  watch_.configure(configuration.filter);
  axis_ = configuration.axis;
  up_ = in_use() ? static_cast<std::size_t>(std::abs(axis_) - 1) : 0;
  scale_30_ = configuration.scale_30;
  lag_ticks_ = configuration.lag_ticks;
  left_half_travel_ = configuration.left_half_travel;
  right_half_travel_ = configuration.right_half_travel;
  left_path_28_ = configuration.left_path_28;
  right_path_28_ = configuration.right_path_28;
  slip_stops_ = configuration.slip_stops;
  if (!begins) return;
  filter_ = {};
  filter_.configure(configuration.filter);
  count_nradps_ = 0;
  about_up_ = 0;
  of_sample_ = State::silent;
  state_ = in_use() ? State::absent : State::off;
  begin_at(drive);
}

/// The tick is held meanwhile, so that what takes long is left to the next step.
void GyroHeading::pose_was_set(const Drive& drive) {
  fused_.set_pose(drive.pose());
  fused_us_ = 0;
  stepped_ = false;
  begins_ = true;
}

void GyroHeading::begin_at(const Drive& drive) {
  fused_.set_pose(drive.pose());
  left_counts_ = drive.wheels().left_counts();
  right_counts_ = drive.wheels().right_counts();
  theta_ = drive.pose().theta;
  correction_64_ = static_cast<std::uint64_t>(filter_.correction_48()) << 16;
  history_.fill(wheels_of(drive));
  lagging_ = history_[0];
  held_ticks_ = 0;
  watch_.reset();
  step_ = {};
  sum_ = 0;
  fused_us_ = 0;
  stepped_ = false;
  partial_ = true;
  begins_ = false;
}

bool GyroHeading::take_slip(UnseenTurn& slip) {
  if (!slip_waits_) return false;
  slip_waits_ = false;
  slip = slip_;
  return true;
}

bool GyroHeading::advance(const hal::GyroReading& reading, const Drive& drive, std::uint64_t now_us) {
  if (reading.number != sample_) take_sample(reading);
  ++held_ticks_;
  switch (drive.phase()) {
    case kFilterPhase:
      if (begins_) [[unlikely]]
        begin_at(drive);
      hold();
      works_ = reading.state == hal::GyroReading::State::running;
      if (!works_) [[unlikely]]
        note(of_board(reading.state));
      make_step(drive);
      return false;
    case kFilterPhase + 1:
      step_filter();
      return false;
    case kFilterPhase + 2:
      step_watch(now_us);
      return slip_stops_ && watch_.slipping();
    case kFilterPhase + 3:
      step_pose(drive, now_us);
      return false;
    default:
      return false;
  }
}

// Saturation is the least of the faults, so it is the worst of a step only if there is no other.
void GyroHeading::note(State now) {
  if (now != State::running && (now != State::saturated || worst_ == State::running)) worst_ = now;
}

void GyroHeading::hold() {
  if (held_ticks_ == 0) return;
  sum_ += held_ticks_ * about_up_;
  age_ticks_ = std::min(age_ticks_ + held_ticks_, kSilence_ticks + 1);
  held_ticks_ = 0;
  note(age_ticks_ <= kSilence_ticks ? of_sample_ : State::silent);
}

void GyroHeading::take_sample(const hal::GyroReading& reading) {
  hold();
  sample_ = reading.number;
  age_ticks_ = 0;
  same_ = hal::same_rate(reading.rate, rate_) ? std::min(same_ + 1, kFrozen_samples) : 0;
  rate_ = reading.rate;
  temperature_cC_ = reading.temperature_cC;
  if (reading.count_nradps != count_nradps_) note_scale(reading.count_nradps);
  about_up_ = axis_ > 0 ? rate_[up_] : -rate_[up_];
  of_sample_ = same_ >= kFrozen_samples                               ? State::frozen
               : exceeds(about_up_, hal::GyroReading::kSaturated - 1) ? State::saturated
                                                                      : State::running;
}

GyroHeading::State GyroHeading::of_board(hal::GyroReading::State state) {
  switch (state) {
    case hal::GyroReading::State::absent:
      return State::absent;
    case hal::GyroReading::State::starting:
      return State::starting;
    case hal::GyroReading::State::failed:
      return State::failed;
    default:
      return State::running;
  }
}

void GyroHeading::note_scale(std::uint32_t count_nradps) {
  count_nradps_ = count_nradps;
  constexpr std::uint32_t kMost_nradps = 1 << 22;  // a range of 7,800 degrees a second
  count_48_ = ((std::min(count_nradps, kMost_nradps) * kTickTurn_68) << 10) / scale_30_;
}

GyroHeading::Wheels GyroHeading::wheels_of(const Drive& drive) {
  const std::uint32_t left = drive.wheels().left_edges(), right = drive.wheels().right_edges();
  const std::uint64_t rolled_28 = std::uint64_t{left - left_edges_} * left_path_28_ +
                                  std::uint64_t{right - right_edges_} * right_path_28_;
  left_edges_ = left;
  right_edges_ = right;
  return {static_cast<std::uint32_t>(drive.pose().theta.raw() >> 32),
          history_[at_].path_20 + static_cast<std::uint32_t>(rolled_28 >> 8)};
}

GyroHeading::Wheels GyroHeading::wheels_at_lag() const {
  const auto steps = static_cast<std::size_t>(lag_ticks_ / kTicks);
  constexpr auto kTenth_31 = static_cast<std::int32_t>((std::int64_t{1} << 31) / kTicks);
  const std::int32_t rest_31 = lag_ticks_ % kTicks * kTenth_31;
  const Wheels& newer = history_[(at_ + kHistory - steps) % kHistory];
  const Wheels& older = history_[(at_ + kHistory - steps - 1) % kHistory];
  const auto between = [rest_31](std::uint32_t to, std::uint32_t from) {
    const auto whole = static_cast<std::int32_t>(to - from);
    return to - static_cast<std::uint32_t>(mul_wide(whole, rest_31) >> 31);
  };
  return {between(newer.theta_32, older.theta_32), between(newer.path_20, older.path_20)};
}

void GyroHeading::make_step(const Drive& drive) {
  const Wheels newest = wheels_of(drive);
  at_ = (at_ + 1) % kHistory;
  history_[at_] = newest;
  const Wheels now = wheels_at_lag();
  step_ = {sum_ * count_48_, static_cast<std::int32_t>(now.theta_32 - lagging_.theta_32),
           now.path_20 - lagging_.path_20};
  lagging_ = now;
  sum_ = 0;
}

void GyroHeading::step_filter() {
  if (std::exchange(partial_, false)) {
    worst_ = State::running;
    return;
  }
  const bool good = worst_ == State::running;
  // A saturated gyro says that the robot turns at least so far. If that is further than the wheels say, it is the slip that must
  // not be missed: a hard kick.
  const bool beyond_wheels =
      worst_ == State::saturated && magnitude(step_.gyro_48) > magnitude(std::int64_t{step_.wheels_32} << 16);
  stepped_ = good || beyond_wheels;
  state_ = !good ? worst_ : filter_.knows_bias() ? State::running : State::learning;
  worst_ = State::running;
  if (stepped_) {
    filter_.advance(step_, good && !watch_.slipping());
  } else {
    filter_.skip();
  }
}

void GyroHeading::step_watch(std::uint64_t now_us) {
  if (!stepped_ || !filter_.knows_bias()) return watch_.reset();
  if (!watch_.advance(step_, filter_)) return;
  ++slips_;
  slip_waits_ = true;
  constexpr std::int64_t kMost_32 = std::int64_t{1} << 31;
  const std::int64_t turn = (clamp_abs(watch_.unseen_32(), kMost_32) * kUnseen_32) >> 32;
  slip_ = {now_us, static_cast<std::int16_t>(clamp_abs(turn, std::int64_t{INT16_MAX}))};
}

void GyroHeading::step_pose(const Drive& drive, std::uint64_t now_us) {
  if (begins_) [[unlikely]]
    return;
  const std::int32_t left = drive.wheels().left_counts(), right = drive.wheels().right_counts();
  const std::int64_t travel = mul_low(left_half_travel_, wrapping_difference(left, left_counts_)) +
                              mul_low(right_half_travel_, wrapping_difference(right, right_counts_));
  const std::uint64_t correction = static_cast<std::uint64_t>(filter_.correction_48()) << 16;
  const std::int64_t turn =
      drive.pose().theta - theta_ + static_cast<std::int64_t>(correction - correction_64_);
  constexpr std::int64_t kEighth = std::int64_t{1} << 61;
  const std::int64_t now = clamp_abs(turn, kEighth);  // what is beyond the integrator's domain waits a step
  fused_.advance(travel, now);
  left_counts_ = left;
  right_counts_ = right;
  theta_ = drive.pose().theta;
  correction_64_ = correction - static_cast<std::uint64_t>(turn - now);
  fused_us_ = now_us;
}

protocol::FusedGroup GyroHeading::report(const Drive& drive, std::uint64_t time_us) const {
  const Pose& pose = in_use() ? fused_.pose() : drive.pose();
  const std::int64_t bias_48 = filter_.bias_48();
  // The shift comes first: without it the product would overflow beyond 8.39 rad/s.
  const auto rate_uradps = [](std::int64_t turn_48) {
    return saturate32(((turn_48 >> 8) * kStepRate_32) >> 32);
  };
  return {in_use() && fused_us_ != 0 ? fused_us_ : time_us,
          pose.x,
          pose.y,
          pose.theta.raw(),
          pose.turns,
          stepped_ ? rate_uradps(step_.gyro_48 - bias_48) : 0,
          rate_uradps(bias_48),
          temperature_cC_,
          state_,
          slips_};
}

}  // namespace astro
