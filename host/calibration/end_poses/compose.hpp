#pragma once

#include "host/calibration/motion/wheel_factors.hpp"

/// Applies measured ratios to the factors that were loaded in the robot while they were measured.
namespace astro::calibration {

/// The factors to load after E_d and E_b were measured with `loaded`:
///
///   c_R / c_L  = E_d * (c_R / c_L) loaded,   c_R + c_L as loaded,   b = E_b * b loaded
///
/// For a nominal robot (c_R = c_L = 1) this is c_R = 2 E_d / (E_d + 1), c_L = 2 / (E_d + 1).
///
/// Units   E_d = D_R / D_L and E_b = b_actual / b_odometry are pure ratios.
/// Errors  none; the arguments are positive.
/// Source  Borenstein & Feng 1996, who have c_R + c_L = 2.
WheelFactors compose(const WheelFactors& loaded, double E_d, double E_b);

/// Throws astro::Error unless all three factors are finite and positive.
void require_usable(const WheelFactors& loaded);

}  // namespace astro::calibration
