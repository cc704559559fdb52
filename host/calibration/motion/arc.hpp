#pragma once

#include <cmath>

#include "host/base/pose2.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// The arc of constant twist: the motion of a robot between two samples of its wheels.
namespace astro::calibration {

/// The longest time that one arc covers, also in gaps of truth.
inline constexpr double kLongestStep_s = 0.06;

/// Moves `pose` along the arc that the two wheel travels give on wheelbase b. Exact while the ratio of the wheels'
/// speeds does not change. Source  Chong & Kleeman 1997.
inline void advance(Pose2& pose, double right_m, double left_m, double b_m) {
  pose = pose * Twist2{(right_m + left_m) / 2, 0, (right_m - left_m) / b_m}.exp();
}

/// The fraction of e that acts on an arc of these wheel travels: 1 on a line, 0 in a spin. With the arc's curvature kappa it is
/// 1 / (1 + kappa b / kappa0). Precondition: a wheel moves.
inline double straightness(double right_m, double left_m, double kappa0) {
  const double along = kappa0 * std::abs(right_m + left_m) / 2;
  return along / (along + std::abs(right_m - left_m));
}

/// The wheelbase about which the robot turns on an arc of these (true) wheel travels. A tyre has width: the point of its
/// contact patch about which it turns in a spin is not the one on which it rolls in a gentle arc.
inline double effective_wheelbase_m(double right_m, double left_m, const WheelFactors& factors) {
  if (factors.e == 0 || (right_m == 0 && left_m == 0)) return factors.b_m;
  return factors.b_m * (1 + factors.e * straightness(right_m, left_m, factors.kappa0));
}

/// Moves `pose` along the arc that these nominal wheel travels give on a robot with these factors.
inline void advance(Pose2& pose, double nominal_right_m, double nominal_left_m, const WheelFactors& factors) {
  const double right_m = factors.c_r * nominal_right_m, left_m = factors.c_l * nominal_left_m;
  advance(pose, right_m, left_m, effective_wheelbase_m(right_m, left_m, factors));
}

}  // namespace astro::calibration
