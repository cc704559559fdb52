#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "host/calibration/likelihood/gyro_pose_uncertainty.hpp"
#include "host/calibration/likelihood/pose_uncertainty.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

namespace astro::live {

/// How the robot's odometry converts counts, from the robot's parameters.
struct OdometryGeometry {
  calibration::WheelFactors factors;
  double count_m = 0;                                       // nominal travel of a wheel for one count
  double observer_bandwidth_radps = 0;                      // of the observer of wheel speeds
  double fastest_mps = HUGE_VAL, fastest_radps = HUGE_VAL;  // the robot's limits
  calibration::GyroErrors gyro = {};
  std::array<double, 3> gyro_settings = {};  // gyro_axis, gyro_scale, gyro_lag

  /// The gyro's scale counts as known to 0.1 % if somebody has set it, and to 1 % as it comes from its maker.
  /// `parameters`: by name, as robot::RemoteParameters::numbers() returns them. Throws astro::Error if one is missing.
  static OdometryGeometry of(const std::map<std::string, double>& parameters);
};

/// Whether both are the same up to the robot's rounding.
bool same(const calibration::WheelFactors& a, const calibration::WheelFactors& b);

/// The errors of a robot that nobody has calibrated: its wheels slip like those of the thesis's robot; c_R and c_L are each
/// known to 0.5 %, b to 1 % and e to 0.02.
///
/// Source  the thesis's robot, uncalibrated: wheels differ by 0.416 %, wheelbase off by 0.479 %.
calibration::OdometryErrors uncalibrated_errors(double wheelbase_m);

}  // namespace astro::live
