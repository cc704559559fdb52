#pragma once

#include <Eigen/Core>

#include "host/calibration/likelihood/moves.hpp"
#include "host/calibration/likelihood/robust_mode.hpp"
#include "host/calibration/likelihood/sample_selection.hpp"
#include "host/calibration/motion/trajectory.hpp"

namespace astro::calibration {

/// Gradient and curvature of -2 log likelihood by the logarithms of K, sigma_xy^2 and sigma_theta^2, with the
/// other unknowns held. The curvature is its expectation, as in Fisher's scoring.
struct NoiseSlope {
  static constexpr int kNoises = 3;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
};

/// One pass of the Kalman filter along a run.
NoiseSlope noise_slope(const Moves& moves, const NoiseModel& noise, RobustMode robust = RobustMode::none,
                       const SampleSelection& samples = {});

}  // namespace astro::calibration
