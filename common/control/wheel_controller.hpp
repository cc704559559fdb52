#pragma once

#include <cstdint>

#include "common/fixed/fixed.hpp"
#include "common/fixed/multiply.hpp"
#include "common/fixed/saturate.hpp"
#include "common/params/parameter_set.hpp"

namespace astro {

/// The gains of one wheel's controller, in the units of the parameters.
struct WheelGains {
  Q16 kp, ki;      // V s/m, V/m
  Q16 kS, kV, kA;  // V, V s/m, V s^2/m
};

/// The same gains in the units of a tick. They take divisions, so they are computed outside the tick.
struct WheelTerms {
  WheelTerms() = default;
  WheelTerms(const WheelGains& gains);  // NOLINT(google-explicit-constructor): the same gains in other units

  Q16 kp, kS_per_fade, kV, kA;
  std::int32_t ki_tick_24 = 0;  // uV per (um/s) and tick
};

/// What one tick of the controller works on.
struct WheelPoint {
  std::int32_t set_point_umps = 0, acceleration_umps2 = 0;
  std::int32_t error_umps = 0;  // by how much the wheel is to turn faster
};

WheelGains left_gains(const ParameterSet& set);
WheelGains right_gains(const ParameterSet& set);

/// Speed control of one wheel: feed-forward from the motor's model, and PI for what the model leaves out.
///
///   u = kS sign(v) + kV v + kA a + kp e + ki integral(e) dt
///
/// kS fades in over the first 8 mm/s, so that a set point near zero does not rattle the gears. Anti-windup:
/// while the output is limited, the integral only takes errors that lead out of the limit, and is itself
/// limited.
///
/// Units   speeds 1e-6 m/s, acceleration 1e-6 m/s^2, voltages 1e-6 V; one call a tick (1 ms).
/// Cost    constant, no division; callable from the control tick.
class WheelController {
 public:
  /// Bumpless: the integral takes up the difference between the old and the new gains at the present point,
  /// so the voltage does not jump.
  void set_gains(const WheelTerms& terms, const WheelPoint& before = {}, const WheelPoint& now = {});

  /// Returns the motor voltage, within +-limit_uv, and sets `limited` if it would have been more; leaves
  /// `limited` as it is otherwise.
  std::int32_t advance(const WheelPoint& at, std::int32_t limit_uv, bool& limited);
  void reset() { integral_24_ = 0; }

 private:
  friend struct WheelTerms;
  // kS fades in over 2^13 um/s, in steps of 2^-6 um/s so that both ends of the fade are symmetrical.
  static constexpr int kFadeInBits = 13, kFineBits = 6;

  /// The control law: the integral, and all that the present tick adds to it; 2^-16 uV.
  std::int64_t sum(std::int64_t integral_16, const WheelPoint& at) const;
  /// The voltage to return when `sum_uv` is beyond the limit; the integral as anti-windup wants it.
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

inline std::int32_t WheelController::advance(const WheelPoint& at, std::int32_t limit_uv, bool& limited) {
  const std::int64_t sum_16 = sum(integral_24_ >> 8, at);

  // Beyond 2^30 uV a sum is only known to be far beyond any limit.
  const std::int32_t high = saturate_to<15>(static_cast<std::int32_t>(sum_16 >> 32));
  const auto sum_uv = static_cast<std::int32_t>(static_cast<std::uint32_t>(high) << 16 |
                                                static_cast<std::uint32_t>(sum_16) >> 16);
  if (exceeds(sum_uv, limit_uv)) [[unlikely]] {
    limited = true;
    return limit(sum_uv, at.error_umps, limit_uv);
  }
  integral_24_ = mul_add(integral_24_, at.error_umps, terms_.ki_tick_24);
  return sum_uv;
}

}  // namespace astro
