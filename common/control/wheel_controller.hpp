#pragma once

#include <cstdint>

#include "common/fixed/fixed.hpp"
#include "common/params/parameter_set.hpp"

namespace astro {

/// Speed control of one wheel: feed-forward of the motor's own model, and PI for what the model does not
/// know.
///
///   u = kS sign(v) + kV v + kA a + kp e + ki integral(e) dt,   e = v - measured
///
/// kS fades in over the first 10 mm/s so that a set point that hovers around zero does not rattle the gears.
/// Anti-windup: while the output is limited, the integral takes only errors that lead out of the limit.
///
/// Units   speeds 1e-6 m/s, acceleration 1e-6 m/s^2, voltages 1e-6 V; one call a tick (1 ms).
/// Cost    constant, no division; callable from the control tick.
class WheelController {
 public:
  /// Keeps the integral, so the output does not jump because a gain changed that is multiplied by zero.
  void set_gains(const ParameterSet& set);

  /// Returns the motor voltage, within +-limit_uv.
  std::int32_t advance(std::int32_t set_point_umps, std::int32_t acceleration_umps2,
                       std::int32_t measured_umps, std::int32_t limit_uv);
  void reset() { integral_24_ = 0; }

 private:
  void integrate(std::int32_t error_umps, std::int32_t limit_uv);

  Q16 kp_, kS_per_fade_, kV_, kA_;
  std::int32_t ki_tick_24_ = 0;   // uV per (um/s) and tick
  std::int64_t integral_24_ = 0;  // uV
};

}  // namespace astro
