#pragma once

#include <Eigen/Core>

#include "host/calibration/likelihood/pose_uncertainty.hpp"

namespace astro::calibration {

/// What is not known of a gyro.
struct GyroErrors {
  double random_walk_rad = 4.363e-4;  // of the angle, in a root second: 0.025 degrees
  double bias_walk_radps = 1.745e-5;  // in a root second: 0.001 degrees a second
  double scale = 0.01;                // standard error of the scale
};

/// How uncertain a pose is whose heading is that of a gyro and whose travel is that of the wheels: the covariance of (x, y, theta) in
/// metres and radians, in the frame of the odometry.
///
/// The errors of the pose are propagated step by step together with those that last: the gyro's bias and scale, the wheels' factors.
/// In a step of time T with the travel d and the turn phi,
///
///   e_theta += e_bias T + e_scale phi + walk sqrt(T),   (e_x, e_y) += travel's error along the heading + d e_theta across it
///
/// At rest the wheels say that nothing turns. The robot's filter then corrects heading and bias with the gains of a Kalman filter,
/// and the position not, which is what is computed here. A robot whose wheels stand and that turns all the same was pushed: then the
/// gyro alone counts. While the gyro does not count, the heading's error grows as the wheels', and by the whole turn while it is
/// saturated.
///
/// Source  the robot's own filter (common/kinematics/heading_filter.hpp); the curvature effect e of the wheels is left out, which
///         matters only while the gyro does not count
class GyroPoseUncertainty {
 public:
  GyroPoseUncertainty(const WheelFactors& factors, const OdometryErrors& wheels, const GyroErrors& gyro);

  /// Sets the covariance of the pose to `start`.
  void restart(double heading_rad, const Symmetric3& start = {});

  struct Step {
    double right_m = 0, left_m = 0;  // nominal travels of the wheels
    double turn_rad = 0;             // of the pose with the gyro
    double time_s = 0;
    bool gyro_counts = false;  // its bias is known, and it works
    bool saturated = false;    // it does not count, but the robot has turned at least so far
  };
  void advance(const Step& step);

  Symmetric3 covariance() const;

 private:
  static constexpr int kX = 0, kY = 1, kTheta = 2, kBias = 3, kScale = 4, kRight = 5, kLeft = 6, kBase = 7;
  using Matrix = Eigen::Matrix<double, 8, 8>;
  using Vector = Eigen::Matrix<double, 8, 1>;

  bool is_pushed(const Step& step) const;
  void move(const Step& step, Matrix& propagation, Matrix& noise) const;
  void turn_by_gyro(const Step& step, Matrix& propagation, Matrix& noise) const;
  void turn_by_wheels(const Step& step, Matrix& propagation, Matrix& noise) const;
  void rest(const Step& step, Matrix& propagation, Matrix& noise) const;

  WheelFactors factors_;
  OdometryErrors wheels_;
  GyroErrors gyro_;
  double heading_rad_ = 0, rested_s_ = 0;
  Matrix covariance_ = Matrix::Zero();
};

}  // namespace astro::calibration
