#pragma once

#include <cstdint>

#include "common/fixed/fixed.hpp"
#include "common/fixed/multiply.hpp"
#include "common/fixed/saturate.hpp"
#include "common/params/parameter_set.hpp"

namespace astro {

/// What one wheel's controller works with, in the units of the parameters.
struct WheelGains {
  Q16 kp, ki;      // V s/m, V/m
  Q16 kS, kV, kA;  // V, V s/m, V s^2/m
};

/// The same as a tick works with it. Takes divisions: made outside the tick.
struct WheelTerms {
  WheelTerms() = default;
  WheelTerms(const WheelGains& gains);  // NOLINT(google-explicit-constructor): the same gains in other units

  Q16 kp, kS_per_fade, kV, kA;
  std::int32_t ki_tick_24 = 0;  // uV per (um/s) and tick
};

/// What the wheel is told and what it lacks.
struct WheelPoint {
  std::int32_t set_point_umps = 0, acceleration_umps2 = 0, error_umps = 0;
};

WheelGains left_gains(const ParameterSet& set);
WheelGains right_gains(const ParameterSet& set);

/// Speed control of one wheel: feed-forward of the motor's own model, and PI for what the model does not
/// know.
///
///   u = kS sign(v) + kV v + kA a + kp e + ki integral(e) dt
///
/// kS fades in over the first 8 mm/s so that a set point that hovers around zero does not rattle the gears.
/// Anti-windup: while the output is limited, the integral takes only errors that lead out of the limit, and
/// is itself no more than the limit.
///
/// Units   speeds 1e-6 m/s, acceleration 1e-6 m/s^2, voltages 1e-6 V; one call a tick (1 ms).
/// Cost    constant, no division; callable from the control tick.
class WheelController {
 public:
  /// Without a bump: at the point where the wheel now works, the integral takes up what the new gains give
  /// more or less than the old ones.
  void set_gains(const WheelTerms& terms, const WheelPoint& before = {}, const WheelPoint& now = {});

  /// `error_umps`: by how much the wheel is to turn faster. Returns the motor voltage, within +-limit_uv, and
  /// sets `limited` if it would have been more; leaves it as it is otherwise.
  std::int32_t advance(std::int32_t set_point_umps, std::int32_t acceleration_umps2, std::int32_t error_umps,
                       std::int32_t limit_uv, bool& limited);
  void reset() { integral_24_ = 0; }

 private:
  friend struct WheelTerms;
  // kS fades in over 2^13 um/s, seen in steps of 2^-6 um/s so that both ends of the fade are alike.
  static constexpr int kFadeInBits = 13, kFineBits = 6;

  /// `integral_16` and all that is not integral, 2^-16 uV.
  std::int64_t sum(std::int64_t integral_16, const WheelPoint& at) const;
  /// What is given when `sum_16` is beyond the limit.
  std::int32_t limit(std::int32_t sum_uv, std::int32_t error_umps, std::int32_t limit_uv);

  WheelTerms terms_;
  std::int64_t integral_24_ = 0;  // uV
};

inline std::int64_t WheelController::sum(std::int64_t integral_16, const WheelPoint& at) const {
  std::int64_t sum_16 = integral_16;
  sum_16 = mul_add(sum_16, terms_.kS_per_fade.raw(),
                   saturate_to<1 + kFadeInBits + kFineBits, kFineBits>(at.set_point_umps));
  sum_16 = mul_add(sum_16, terms_.kV.raw(), at.set_point_umps);
  sum_16 = mul_add(sum_16, terms_.kA.raw(), at.acceleration_umps2);
  return mul_add(sum_16, terms_.kp.raw(), at.error_umps);
}

inline std::int32_t WheelController::advance(std::int32_t set_point_umps, std::int32_t acceleration_umps2,
                                             std::int32_t error_umps, std::int32_t limit_uv, bool& limited) {
  std::int64_t sum_16 = integral_24_ >> 8;
  sum_16 = mul_add(sum_16, terms_.kS_per_fade.raw(),
                   saturate_to<1 + kFadeInBits + kFineBits, kFineBits>(set_point_umps));
  sum_16 = mul_add(sum_16, terms_.kV.raw(), set_point_umps);
  sum_16 = mul_add(sum_16, terms_.kA.raw(), acceleration_umps2);
  sum_16 = mul_add(sum_16, terms_.kp.raw(), error_umps);

  // Beyond 2^30 uV a sum is only known to be far beyond any limit.
  const std::int32_t high = saturate_to<15>(static_cast<std::int32_t>(sum_16 >> 32));
  const auto sum_uv = static_cast<std::int32_t>(static_cast<std::uint32_t>(high) << 16 |
                                                static_cast<std::uint32_t>(sum_16) >> 16);
  if (exceeds(sum_uv, limit_uv)) [[unlikely]] {
    limited = true;
    return limit(sum_uv, error_umps, limit_uv);
  }
  integral_24_ = mul_add(integral_24_, error_umps, terms_.ki_tick_24);
  return sum_uv;
}

}  // namespace astro
