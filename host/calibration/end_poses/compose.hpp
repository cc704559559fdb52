#pragma once

#include "host/calibration/motion/wheel_factors.hpp"

/// What a measured pair of ratios does to the factors that the robot carried while it was measured.
namespace astro::calibration {

/// Loads E_d and E_b on top of `carried`:
///
///   c_R / c_L  = E_d * (c_R / c_L) carried,   c_R + c_L as carried,   b = E_b * b carried
///
/// For a nominal robot (c_R = c_L = 1) this is c_R = 2 E_d / (E_d + 1), c_L = 2 / (E_d + 1): the faster
/// growing wheel is the larger one.
///
/// Units   E_d = D_R / D_L and E_b = b_actual / b_believed are pure ratios.
/// Errors  none; the arguments are positive.
/// Source  Borenstein & Feng 1996, who have c_R + c_L = 2.
WheelFactors compose(const WheelFactors& carried, double E_d, double E_b);

/// Throws astro::Error unless all three factors are finite and positive.
void require_usable(const WheelFactors& carried);

}  // namespace astro::calibration
