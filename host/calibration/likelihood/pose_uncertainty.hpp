#pragma once

#include "host/calibration/likelihood/matrix3.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/likelihood/moves.hpp"

namespace astro::calibration {

/// The sources of a robot's odometry errors: slip along its path, and the uncertainty of its factors.
struct OdometryErrors {
  double K_m = 0;  // variance of the slip of a wheel for each metre that it turns, in m^2/m
  FactorCovariance factors = FactorCovariance::Zero();
};

/// How uncertain a dead-reckoned pose is: the covariance of (x, y, theta) in metres and radians, in the frame of the odometry.
///
///     P = F P0 F' + R (K Q + J C J') R'
///
/// P0 is the covariance of the pose at the start. F propagates it, because an error of the start heading turns the path about
/// the start. R turns the robot's frame at the start into that of the odometry. In the robot's frame at the start, Q is the
/// covariance of the end pose by slip of variance |d| of each wheel, summed over all arcs, and J holds the derivatives of that
/// pose by c_R, c_L, b and e, whose covariance is C. The errors of the factors are the same all along the path. So their
/// effects add up with their signs, and cancel if the robot drives back; independent noise in each step would not do that.
///
/// Source  slip: Chong & Kleeman 1997; J by the chain rule along the path (moves.hpp).
class PoseUncertainty {
 public:
  /// `factors`: those that the odometry uses.
  PoseUncertainty(const WheelFactors& factors, const OdometryErrors& errors)
      : factors_(factors), errors_(errors) {}

  /// Sets the covariance of the pose to `start`. What the wheels did before no longer contributes.
  void restart(double heading_rad, const Symmetric3& start = {});

  /// The nominal travels of the wheels since the last call.
  void travel(double right_m, double left_m);

  Symmetric3 covariance() const;

 private:
  Move whole() const;

  WheelFactors factors_;
  OdometryErrors errors_;
  double heading_rad_ = 0;
  Symmetric3 start_;
  Move way_;
  double right_m_ = 0, left_m_ = 0;  // since the end of way_
};

}  // namespace astro::calibration
