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

WheelGains left_gains(const ParameterSet& set);
WheelGains right_gains(const ParameterSet& set);

/// Speed control of one wheel: feed-forward of the motor's own model, and PI for what the model does not
/// know.
///
///   u = kS sign(v) + kV v + kA a + kp e + ki integral(e) dt,   e = v - measured
///
/// kS fades in over the first 8 mm/s so that a set point that hovers around zero does not rattle the gears.
/// Anti-windup: while the output is limited, the integral takes only errors that lead out of the limit.
///
/// Units   speeds 1e-6 m/s, acceleration 1e-6 m/s^2, voltages 1e-6 V; one call a tick (1 ms).
/// Cost    constant, no division; callable from the control tick.
class WheelController {
 public:
  /// Keeps the integral, so the output does not jump because a gain changed that is multiplied by zero.
  void set_gains(const WheelGains& gains);

  /// Returns the motor voltage, within +-limit_uv.
  std::int32_t advance(std::int32_t set_point_umps, std::int32_t acceleration_umps2,
                       std::int32_t measured_umps, std::int32_t limit_uv);
  void reset() { integral_24_ = 0; }

 private:
  // kS fades in over 2^13 um/s, seen in steps of 2^-6 um/s so that both ends of the fade are alike.
  static constexpr int kFadeInBits = 13, kFineBits = 6;

  void integrate(std::int32_t error_umps, std::int32_t limit_uv);

  Q16 kp_, kS_per_fade_, kV_, kA_;
  std::int32_t ki_tick_24_ = 0;   // uV per (um/s) and tick
  std::int64_t integral_24_ = 0;  // uV
};

inline std::int32_t WheelController::advance(std::int32_t set_point_umps, std::int32_t acceleration_umps2,
                                             std::int32_t measured_umps, std::int32_t limit_uv) {
  const std::int32_t error = subtract_saturated(set_point_umps, measured_umps);
  std::int64_t sum_16 =
      mul_wide(kS_per_fade_.raw(), saturate_to<1 + kFadeInBits + kFineBits, kFineBits>(set_point_umps));
  sum_16 = mul_add(sum_16, kV_.raw(), set_point_umps);
  sum_16 = mul_add(sum_16, kA_.raw(), acceleration_umps2);
  sum_16 = mul_add(sum_16, kp_.raw(), error) + (integral_24_ >> 8);

  const std::int64_t limit_16 = std::int64_t{limit_uv} << 16;
  if (sum_16 >= limit_16) {
    if (error < 0) integrate(error, limit_uv);
    return limit_uv;
  }
  if (sum_16 <= -limit_16) {
    if (error > 0) integrate(error, limit_uv);
    return -limit_uv;
  }
  integrate(error, limit_uv);
  return static_cast<std::int32_t>(sum_16 >> 16);
}

inline void WheelController::integrate(std::int32_t error_umps, std::int32_t limit_uv) {
  integral_24_ = mul_add(integral_24_, error_umps, ki_tick_24_);
  const auto integral_uv_8 = static_cast<std::int32_t>(integral_24_ >> 32);  // in 256 uV: enough to clamp by
  if (integral_uv_8 > limit_uv >> 8) integral_24_ = std::int64_t{limit_uv} << 24;
  if (integral_uv_8 < -limit_uv >> 8) integral_24_ = -(std::int64_t{limit_uv} << 24);
}

}  // namespace astro
