#pragma once

#include "host/calibration/likelihood/matrix3.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/likelihood/moves.hpp"

namespace astro::calibration {

/// What a robot's odometry may be wrong by: slip on its way, and factors that are known so well and no better.
struct OdometryErrors {
  double K_m = 0;  // variance of the slip of a wheel for each metre that it turns, in m^2/m
  FactorCovariance factors = FactorCovariance::Zero();
};

/// How uncertain a dead-reckoned pose is: the covariance of (x, y, theta) in metres and radians, in the frame of the odometry.
///
///     P = F P0 F' + R (K Q + J C J') R'
///
/// P0 is that of the pose at the start, which an error of the heading turns about that pose (F); R turns the robot's frame at
/// the start into that of the odometry. In the robot's frame at the start, Q is the sum over all arcs of what slip of variance
/// |d| of each wheel does to the pose at the end, and J holds the derivatives of that pose by c_R, c_L, b and e, whose
/// covariance is C. Wrong factors are wrong in the same way all along: their errors add up with their signs, also to nothing
/// where a robot drives back, which no noise of each step would do.
///
/// Source  slip: Chong & Kleeman 1997; J by the chain rule along the path (moves.hpp).
class PoseUncertainty {
 public:
  /// `factors`: those that the odometry uses.
  PoseUncertainty(const WheelFactors& factors, const OdometryErrors& errors)
      : factors_(factors), errors_(errors) {}

  /// The pose is set: from here on it is as uncertain as `start`, and what the wheels did before has no part in it.
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
