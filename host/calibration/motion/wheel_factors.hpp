#pragma once

namespace astro::calibration {

/// The curvature, in units of 1 / b, at which half of e acts. Real drives fit equally well with a fifth or with five times of
/// this, so a calibration does not estimate it.
inline constexpr double kUsualKappa0 = 0.12;

/// The factors that a robot's odometry uses: wheel travel = c * nominal travel, and b is the wheelbase. Gentle arcs turn about
/// b (1 + e), spins about b; in between see effective_wheelbase_m (arc.hpp).
struct WheelFactors {
  double c_r = 1, c_l = 1, b_m = 0;
  double e = 0;
  double kappa0 = kUsualKappa0;  // of no effect while e is 0
};

}  // namespace astro::calibration
