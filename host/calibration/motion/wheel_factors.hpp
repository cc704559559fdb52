#pragma once

namespace astro::calibration {

/// The factors that a robot's odometry uses: wheel travel = c * nominal travel, and b is the wheelbase.
struct WheelFactors {
  double c_r = 1, c_l = 1, b_m = 0;
};

}  // namespace astro::calibration
