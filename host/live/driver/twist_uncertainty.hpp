#pragma once

#include "host/live/driver/odometry_geometry.hpp"

namespace astro::live {

/// Covariance of the speed v (m/s) and the yaw rate omega (rad/s) of the base.
struct TwistCovariance {
  double vv = 0, vw = 0, ww = 0;
};

/// Variance of a speed that the robot's observer (common/control/observer.hpp) computes from whole counts, in (m/s)^2.
///
///     var = 0.0158 (w q)^2 / (1 - w T)
///
/// The observer has both poles at p = 1 - w T, for its bandwidth w and the tick T, and turns the counted position into a speed
/// by H(z) = w^2 T (1 - 1/z) / (1 - p/z)^2. Rounding to counts of length q adds a sawtooth to the position, which at a constant
/// speed has the frequency f = speed / q and at m f the amplitude q / (pi m). With X = p (2 sin(pi f T m) / (w T))^2, nearly
/// p (2 pi f m / w)^2, the speed ripples by
///
///     var = (w q)^2 / (2 pi^2 p)  sum over m of X / (m (1 + X))^2
///
/// whose sum is at most 0.312. That largest value is stated at every speed, because speeds change.
double count_ripple_variance(const OdometryGeometry& geometry);

/// Covariance of the robot's observed velocity, as a measurement of the mean velocity over `period_s`, the time between two
/// messages. It is the sum of the ripple of the counts, of slip with the variance K |speed| / period for each wheel, and of
/// the factors' covariance. Ripple and slip of the two wheels are independent.
TwistCovariance twist_covariance(double v_mps, double omega_radps, double period_s,
                                 const OdometryGeometry& geometry, const calibration::OdometryErrors& errors);

/// Variance of a gyro's rate over 10 ms, in (rad/s)^2: of its walk, of its scale, and of its bias, as half a second at rest shows it.
double gyro_rate_variance(double omega_radps, const calibration::GyroErrors& errors);

}  // namespace astro::live
