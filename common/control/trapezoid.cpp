#include "common/control/trapezoid.hpp"

#include "common/fixed/wide.hpp"

namespace astro {
namespace {

constexpr std::int64_t magnitude(std::int64_t value) { return value < 0 ? -value : value; }

constexpr std::int32_t tighter(std::int32_t wanted, std::int32_t limit) {
  return wanted > 0 && wanted < limit ? wanted : limit;
}

// ceil(distance / rate) in ticks, distance in 1e-6 m or 1e-6 rad, rate per second.
constexpr std::int64_t ticks_at(std::int64_t distance, std::int64_t rate) {
  return (distance * 1000 + rate - 1) / rate;
}

// Ticks in which the acceleration limit takes the speed from rest over half the distance:  t^2 = distance /
// rate.
constexpr std::int64_t triangle_ticks(std::int64_t distance, std::int64_t acceleration) {
  const std::int64_t square = distance * 1'000'000 / acceleration;
  return isqrt(static_cast<std::uint64_t>(square)) + 1;
}

constexpr std::int64_t larger(std::int64_t a, std::int64_t b) { return a > b ? a : b; }

constexpr std::int64_t angle_urad(std::int64_t angle_32) {
  constexpr std::int64_t kTurn_urad = 6'283'185;
  return (magnitude(angle_32) >> 16) * kTurn_urad >> 16;
}

}  // namespace

MotionLimits make_limits(const ParameterSet& set) {
  return {set.get(Param::speed_limit), set.get(Param::yaw_rate_limit), set.get(Param::acceleration_limit),
          set.get(Param::yaw_acceleration_limit)};
}

bool Trapezoid::plan(const Segment& segment, const MotionLimits& limits, Trapezoid& out) {
  if (magnitude(segment.length_nm) > kMaxLength_nm || magnitude(segment.angle_32) > kMaxAngle_32)
    return false;
  const std::int64_t length_um = magnitude(segment.length_nm) / 1000;
  const std::int64_t angle = angle_urad(segment.angle_32);
  if (length_um == 0 && angle == 0) return false;

  // At the level speed the whole segment would take `cruise` ticks; the ramp is as long as the tighter of the
  // two accelerations needs to reach that speed, and no longer than a triangle's.
  const std::int64_t speed = tighter(segment.speed_umps, limits.speed_umps);
  const std::int64_t yaw_rate = tighter(segment.yaw_rate_uradps, limits.yaw_rate_uradps);
  const std::int64_t cruise = larger(1, larger(ticks_at(length_um, speed), ticks_at(angle, yaw_rate)));
  if (cruise > kMaxTicks) return false;
  const std::int64_t reached_speed = length_um * 1000 / cruise;
  const std::int64_t reached_yaw_rate = angle * 1000 / cruise;
  std::int64_t ramp = larger(1, larger(ticks_at(reached_speed, limits.acceleration_umps2),
                                       ticks_at(reached_yaw_rate, limits.yaw_acceleration_uradps2)));
  std::int64_t level = cruise - ramp;
  if (level < 0) {
    ramp = larger(triangle_ticks(length_um, limits.acceleration_umps2),
                  triangle_ticks(angle, limits.yaw_acceleration_uradps2));
    level = 0;
  }

  Trapezoid planned;
  planned.ramp_ = ramp;
  planned.level_ = level;
  // 2^-50 m per nm is 2^50 / 10^9 = 2^41 / 5^9.
  Natural travel(static_cast<std::uint64_t>(magnitude(segment.length_nm)));
  travel <<= 41 + 1;
  travel /= 1'953'125;
  planned.total_ = {segment.length_nm < 0 ? -travel.half_rounded() : travel.half_rounded(),
                    segment.angle_32 * (std::int64_t{1} << 20)};
  const std::int64_t shares = 2 * ramp * (ramp + level);
  planned.unit_ = {planned.total_.travel / shares, planned.total_.turn / shares};
  out = planned;
  return true;
}

Trapezoid::Step Trapezoid::advance() {
  // Shares of one tick: 1, 3, 5, ... 2 ramp - 1 going up, 2 ramp at the level, and down again the same way.
  const std::int64_t from_end = ticks() - 1 - tick_;
  const std::int64_t edge = tick_ < from_end ? tick_ : from_end;
  const std::int64_t shares = edge < ramp_ ? 2 * edge + 1 : 2 * ramp_;
  ++tick_;
  Step step{unit_.travel * shares, unit_.turn * shares};
  if (done()) step = {total_.travel - given_.travel, total_.turn - given_.turn};
  given_.travel += step.travel;
  given_.turn += step.turn;
  return step;
}

}  // namespace astro
