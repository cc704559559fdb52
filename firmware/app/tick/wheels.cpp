#include "firmware/app/tick/wheels.hpp"

#include <algorithm>

#include "common/fixed/multiply.hpp"
#include "common/fixed/saturate.hpp"
#include "common/fixed/wide.hpp"
#include "common/fixed/wrapping.hpp"

namespace astro {
namespace {

constexpr std::int32_t kFullDuty = 32767;
constexpr std::int32_t kLeastSupply_mv = 1000;  // a lower reading cannot be the supply, and may be 0

std::int32_t speed_umps(const Geometry::Wheel& wheel, const SpeedObserver& observer) {
  // Unless a count is very coarse: the same in one instruction.
  if (const auto fine = static_cast<std::int32_t>(wheel.speed); fine == wheel.speed) [[likely]]
    return mul_high(fine, observer.speed());
  return saturate32(mul_high(wheel.speed, observer.speed()));
}

// In one tick a wheel may not turn the robot by more than a sixteenth of a turn (the odometry's domain), nor
// count more than the speed observer can take. Both are hundreds of times what a motor does. The turns of the geometry are
// about b, and a curve may turn about a smaller wheelbase.
std::int32_t most_counts(const ParameterSet& set, const Geometry& geometry) {
  constexpr std::int64_t kOne_30 = std::int64_t{1} << 30;
  const std::int64_t sixteenth_turn = kOne_30 * (kOne_30 + std::min<std::int32_t>(set.get(Param::e), 0));
  const std::int64_t turn =
      geometry.left.turn > geometry.right.turn ? geometry.left.turn : geometry.right.turn;
  const std::int64_t counts = sixteenth_turn / turn;
  return counts < 1000 ? static_cast<std::int32_t>(counts) : 1000;
}

// Counts of the wheel with the finer counts in a tick at this speed, plus one at each end of the tick.
std::int32_t counts_at(std::int64_t umps, const Geometry& geometry) {
  const std::int64_t finer =
      geometry.left.speed < geometry.right.speed ? geometry.left.speed : geometry.right.speed;
  const std::int64_t counts = (umps << 12) / finer + 2;
  return counts < INT32_MAX ? static_cast<std::int32_t>(counts) : INT32_MAX;
}

// A speed of 2^-12 um/s is 2^20 / wheel.speed in the observer's units, and a tick is a thousandth of a
// second.
std::int32_t expected_scale(const Geometry::Wheel& wheel) {
  const std::uint64_t scale = ~std::uint64_t{0} / (static_cast<std::uint64_t>(wheel.speed) * kTickHz);
  return scale < INT32_MAX ? static_cast<std::int32_t>(scale) : INT32_MAX;
}

}  // namespace

Wheels::Configuration::Configuration(const ParameterSet& set, const Geometry& wheels)
    : geometry(wheels),
      gains(set),
      observer(set.get(Param::observer_bandwidth)),
      most_counts(std::min(astro::most_counts(set, wheels),
                           counts_at(4 * std::int64_t{set.get(Param::over_speed)}, wheels))),
      most_late_counts(astro::most_counts(set, wheels)),
      voltage_limit_uv(1000 * set.get(Param::motor_voltage_max)),
      left{set.get(Param::motor_polarity_left), set.get(Param::encoder_polarity_left),
           expected_scale(wheels.left)},
      right{set.get(Param::motor_polarity_right), set.get(Param::encoder_polarity_right),
            expected_scale(wheels.right)} {}

void Wheels::configure(const Configuration& configuration) {
  geometry_ = configuration.geometry;
  most_counts_ = configuration.most_counts;
  most_late_counts_ = configuration.most_late_counts;
  voltage_limit_uv_ = configuration.voltage_limit_uv;
  pair_.set_gains(configuration.gains, set_points_, accelerations_, speeds_);
  const auto set_wheel = [&](Wheel& wheel, const Configuration::Wheel& to) {
    wheel.motor_sign = to.motor_sign;
    wheel.encoder_sign = to.encoder_sign;
    wheel.expected_scale = to.expected_scale;
    wheel.observer.set_gains(configuration.observer);
  };
  set_wheel(left_, configuration.left);
  set_wheel(right_, configuration.right);
}

std::int32_t Wheels::step(Wheel& wheel, std::int32_t counts) const {
  const std::int32_t step = wrapping_product(wrapping_difference(counts, wheel.seen), wheel.encoder_sign);
  wheel.seen = counts;
  wheel.edges += step < 0 ? 0 - static_cast<std::uint32_t>(step) : static_cast<std::uint32_t>(step);
  return step;
}

Wheels::Steps Wheels::read(const TickInput& input) {
  if (!started_) {
    left_.seen = input.counts.left;
    right_.seen = input.counts.right;
    started_ = true;
  }
  Steps steps{step(left_, input.counts.left), step(right_, input.counts.right), true};
  const std::int32_t most = input.on_time ? most_counts_ : most_late_counts_;
  if (exceeds(steps.left, most) || exceeds(steps.right, most)) steps = {0, 0, false};
  left_counts_ = wrapping_sum(left_counts_, steps.left);
  right_counts_ = wrapping_sum(right_counts_, steps.right);
  left_.observer.advance(steps.left, left_.expected);
  right_.observer.advance(steps.right, right_.expected);
  speeds_ = {speed_umps(geometry_.left, left_.observer), speed_umps(geometry_.right, right_.observer)};
  return steps;
}

hal::Duty Wheels::to_duty(const WheelVoltages& voltages, std::int32_t supply_mv) {
  // Full duty over the supply, 2^-16 per mV; one millivolt is 1000 uV, and 2^-32 * 4294967 is one thousandth.
  const auto per_mv_16 = static_cast<std::int32_t>((static_cast<std::uint32_t>(kFullDuty) << 16) /
                                                   static_cast<std::uint32_t>(supply_mv));
  const auto duty = [&](std::int32_t voltage_uv) {
    const auto thousand_duty = static_cast<std::int32_t>(mul_wide(voltage_uv, per_mv_16) >> 16);
    return static_cast<std::int16_t>(mul_high(thousand_duty, 4'294'967));
  };
  return {duty(voltages.left_uv), duty(voltages.right_uv)};
}

hal::Duty Wheels::control(const WheelSpeeds& set_points, const WheelSpeeds& accelerations,
                          std::int32_t battery_mv) {
  const Supply supply = supply_of(battery_mv);
  set_points_ = set_points;
  accelerations_ = accelerations;
  left_.expected = mul_high(accelerations.left_umps, left_.expected_scale);
  right_.expected = mul_high(accelerations.right_umps, right_.expected_scale);
  return wired(to_duty(pair_.advance(set_points, accelerations, speeds_, supply.limit_uv), supply.mv));
}

hal::Duty Wheels::open_loop(const WheelVoltages& voltages, std::int32_t battery_mv) {
  release();
  const Supply supply = supply_of(battery_mv);
  return wired(
      to_duty({clamp_abs(voltages.left_uv, supply.limit_uv), clamp_abs(voltages.right_uv, supply.limit_uv)},
              supply.mv));
}

Wheels::Supply Wheels::supply_of(std::int32_t battery_mv) const {
  const std::int32_t mv = battery_mv > kLeastSupply_mv ? battery_mv : kLeastSupply_mv;
  return {mv, std::min(1000 * mv, voltage_limit_uv_)};
}

std::int32_t Wheels::half_duty(std::int32_t battery_mv) const {
  const Supply supply = supply_of(battery_mv);
  if (supply.limit_uv == 1000 * supply.mv) return kFullDuty / 2;
  const std::uint32_t limit_mv = static_cast<std::uint32_t>(supply.limit_uv) / 1000;
  return static_cast<std::int32_t>(kFullDuty / 2 * limit_mv / static_cast<std::uint32_t>(supply.mv));
}

hal::Duty Wheels::wired(const hal::Duty& forward) {
  forward_duty_ = forward;
  return {static_cast<std::int16_t>(forward.left * left_.motor_sign),
          static_cast<std::int16_t>(forward.right * right_.motor_sign)};
}

void Wheels::release() {
  pair_.reset();
  left_.expected = right_.expected = 0;
  set_points_ = accelerations_ = {};
  forward_duty_ = {};
}

}  // namespace astro
