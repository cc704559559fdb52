#pragma once

#include <Eigen/Cholesky>
#include <array>
#include <random>

#include "host/calibration/likelihood/pose_uncertainty.hpp"
#include "tests/support/robots/desk.hpp"

/// Robots that differ from their parameters as a calibration leaves them, for claims about how uncertain odometry says it is.
namespace astro::support {

inline constexpr int kDrives = 200;
inline constexpr std::array kMoments_s{5, 20, 60};
// Of the mean of 200 chi-squares of 3 degrees of freedom: the quantiles of chi-square of 600, divided by 200.
inline constexpr double kLeast = 2.666, kMost = 3.349;

/// Of what a calibration of the thesis's robot by some squares leaves: c_R, c_L, b, e. The errors of both wheels go together,
/// because the common scale is known worse than their ratio; the curvature is known to half a per cent.
inline calibration::FactorCovariance left_by_a_calibration() {
  calibration::FactorCovariance root = calibration::FactorCovariance::Zero();
  root.col(0) << 4e-4, 4e-4, 0.29 * 4e-4, 0;  // scale
  root.col(1) << 1e-4, -1e-4, 0, 0;           // ratio of the wheels
  root.col(2) << 0, 0, 0.29 * 1e-3, -1e-3;    // wheelbase
  root.col(3) << 0, 0, 0, 5e-3;               // curvature
  return root * root.transpose();
}

/// A robot that is not what its parameters say.
inline sim::Config drawn(const calibration::FactorCovariance& covariance, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Vector4d error =
      Eigen::LLT<calibration::FactorCovariance>(covariance).matrixL() *
      Eigen::Vector4d(normal(random), normal(random), normal(random), normal(random));
  sim::Config config;
  const double c_r = 1 + error[0], c_l = 1 + error[1];
  config.true_ed = c_r / c_l;
  config.scale = (c_r + c_l) / 2;
  config.true_wheelbase_m = config.nominal_wheelbase_m + error[2];
  config.true_e = error[3];
  config.slip_m = kThesisSlip_m;
  config.seed = random();
  return config;
}

}  // namespace astro::support
