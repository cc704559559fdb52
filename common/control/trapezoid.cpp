#include "common/control/trapezoid.hpp"

#include "common/fixed/saturate.hpp"
#include "common/fixed/wide.hpp"

namespace astro {
namespace {

constexpr std::int64_t larger(std::int64_t a, std::int64_t b) { return a > b ? a : b; }

constexpr std::int32_t tighter(std::int32_t wanted, std::int32_t limit) {
  return wanted > 0 && wanted < limit ? wanted : limit;
}

constexpr std::int64_t ceil_divide(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

// Length or angle of a segment. Distances and ticks are rounded up, so that no limit is exceeded.
struct Motion {
  std::int64_t distance;      // 1e-6 m or 1e-6 rad
  std::int64_t rate;          // per second
  std::int64_t acceleration;  // per second squared

  // Ticks that the whole segment would take at the level speed.
  constexpr std::int64_t cruise() const { return ceil_divide(distance * 1000, rate); }
  // Ticks to reach distance / cruise from rest.
  constexpr std::int64_t ramp(std::int64_t cruise) const {
    return ceil_divide(distance * 1'000'000, cruise * acceleration);
  }
  // Ticks to the middle of the segment, without a level part: t^2 = distance / acceleration.
  constexpr std::int64_t half() const {
    return isqrt(static_cast<std::uint64_t>(distance * 1'000'000 / acceleration)) + 1;
  }
};

constexpr std::int64_t length_um(std::int64_t length_nm) { return ceil_divide(magnitude(length_nm), 1000); }

constexpr std::int64_t angle_urad(std::int64_t angle_32) {
  constexpr std::int64_t kTurn_urad = 6'283'186;  // rounded up
  if (angle_32 == 0) return 0;
  return (((magnitude(angle_32) >> 4) + 1) * kTurn_urad >> 28) + 1;
}

bool acceptable(const Segment& segment) {
  const auto within = [](std::int64_t value, std::int64_t most) { return value >= -most && value <= most; };
  const bool moves = segment.length_nm != 0 || segment.angle_32 != 0;
  return within(segment.length_nm, kMaxLength_nm) && within(segment.angle_32, kMaxAngle_32) &&
         segment.dwell_ms >= 0 && segment.dwell_ms <= kMaxTicks && moves == (segment.dwell_ms == 0);
}

// 2^-50 m per nm is 2^50 / 10^9 = 2^41 / 5^9.
std::int64_t travel_50(std::int64_t length_nm) {
  Natural travel(static_cast<std::uint64_t>(magnitude(length_nm)));
  travel <<= 41 + 1;
  travel /= 1'953'125;
  return length_nm < 0 ? -travel.half_rounded() : travel.half_rounded();
}

// total * 2^bits / shares towards zero, for a quotient that fits.
constexpr std::int64_t share(std::int64_t total, std::int64_t shares, int bits) {
  const std::int64_t scale = std::int64_t{1} << bits;
  return total / shares * scale + total % shares * scale / shares;
}

}  // namespace

MotionLimits make_limits(const ParameterSet& set) {
  return {set.get(Param::speed_limit),        set.get(Param::yaw_rate_limit),
          set.get(Param::acceleration_limit), set.get(Param::yaw_acceleration_limit),
          set.get(Param::jerk_limit),         set.get(Param::yaw_jerk_limit)};
}

bool Trapezoid::plan(const Segment& segment, const MotionLimits& limits, Trapezoid& out) {
  if (!acceptable(segment)) return false;
  if (segment.dwell_ms != 0) {
    out = {};
    out.level_ = out.dwell_ = segment.dwell_ms;
    return true;
  }
  const Motion length{length_um(segment.length_nm), tighter(segment.speed_umps, limits.speed_umps),
                      limits.acceleration_umps2};
  const Motion angle{angle_urad(segment.angle_32), tighter(segment.yaw_rate_uradps, limits.yaw_rate_uradps),
                     limits.yaw_acceleration_uradps2};
  const std::int64_t cruise = larger(1, larger(length.cruise(), angle.cruise()));
  if (cruise > kMaxTicks) return false;

  std::int64_t ramp = larger(1, larger(length.ramp(cruise), angle.ramp(cruise)));
  std::int64_t level = cruise - ramp;
  if (level < 0) {
    ramp = larger(length.half(), angle.half());
    level = 0;
  }
  if (2 * ramp + level > kMaxTicks) return false;
  Trapezoid planned;
  planned.ramp_ = static_cast<std::int32_t>(ramp);
  planned.level_ = static_cast<std::int32_t>(level);
  const std::int64_t shares = 2 * ramp * (ramp + level);
  planned.total_ = {travel_50(segment.length_nm), segment.angle_32 * (std::int64_t{1} << 20)};
  planned.unit_ = {share(planned.total_.travel, shares, kUnitBits),
                   share(planned.total_.turn, shares, kUnitBits)};
  out = planned;
  return true;
}

Trapezoid::Step Trapezoid::advance() {
  // Shares of one tick: 1, 3, 5, ... 2 ramp - 1 going up, 2 ramp at the level, and down again the same way.
  const std::int32_t from_end = 2 * ramp_ + level_ - 1 - tick_;
  const std::int32_t edge = tick_ < from_end ? tick_ : from_end;
  const std::int32_t shares = edge < ramp_ ? 2 * edge + 1 : 2 * ramp_;
  ++tick_;
  // Most segments are a line or a spin.
  const auto share_of = [shares](std::int64_t unit, std::int64_t& rest) {
    if (unit == 0) return std::int64_t{0};
    rest += mul_low(unit, shares);
    const std::int64_t whole = rest >> kUnitBits;
    rest &= (std::int64_t{1} << kUnitBits) - 1;
    return whole;
  };
  Step step{share_of(unit_.travel, rest_.travel), share_of(unit_.turn, rest_.turn)};
  if (done() && !cut_) step = {total_.travel - given_.travel, total_.turn - given_.turn};
  given_.travel += step.travel;
  given_.turn += step.turn;
  return step;
}

void Trapezoid::cut_short() {
  if (cut_ || tick_ >= ramp_ + level_) return;  // it is coming to rest already
  cut_ = true;
  if (tick_ < ramp_) {
    ramp_ = tick_;
    level_ = 0;
  } else {
    level_ = tick_ - ramp_;
  }
}

Segment Trapezoid::rest() const {
  const std::int64_t travel = total_.travel - given_.travel;
  // Whole metres and the fraction separately, so that no product exceeds 64 bits.
  constexpr int kBits = 50, kFineBits = 30;
  constexpr std::int64_t kNanometresPerMetre = 1'000'000'000;
  const std::int64_t whole = travel >> kBits;
  const std::int64_t fine =
      ((travel & ((std::int64_t{1} << kBits) - 1)) + (std::int64_t{1} << (kBits - kFineBits - 1))) >>
      (kBits - kFineBits);
  Segment left;
  left.length_nm = whole * kNanometresPerMetre +
                   ((fine * kNanometresPerMetre + (std::int64_t{1} << (kFineBits - 1))) >> kFineBits);
  left.angle_32 = (total_.turn - given_.turn) >> 20;
  left.dwell_ms = dwell_ != 0 ? dwell_ - tick_ : 0;
  return left;
}

std::uint32_t Trapezoid::progress_16() const {
  // The larger motion, in units that leave room for 16 more bits.
  const bool by_travel = total_.travel != 0;
  const std::int64_t whole = (by_travel ? total_.travel : total_.turn) >> 16;
  if (whole == 0) return ticks() == 0 ? 0 : static_cast<std::uint32_t>(std::int64_t{tick_} * 65536 / ticks());
  return static_cast<std::uint32_t>((by_travel ? given_.travel : given_.turn) / whole);
}

}  // namespace astro
