#pragma once

#include <Eigen/Core>
#include <cmath>

#include "host/calibration/likelihood/unknowns.hpp"
#include "host/calibration/motion/arc.hpp"

/// The motion model and the measurement model of the Kalman filter, with their Jacobians.
namespace astro::calibration {

/// The robot's displacement along one arc, and its Jacobians.
struct Arc {
  double dx_m = 0, dy_m = 0;
  double turn_rad = 0;
  Eigen::Vector3d jacobian_left = Eigen::Vector3d::Zero(),
                  jacobian_right = Eigen::Vector3d::Zero();  // by the wheel's travel in m
  Eigen::Vector3d jacobian_turn = Eigen::Vector3d::Zero();   // by turn_rad, the centre's travel held
};

inline Arc arc_of(double theta_rad, double left_m, double right_m, double b_m) {
  Arc arc;
  arc.turn_rad = (right_m - left_m) / b_m;
  const double half = arc.turn_rad / 2, centre_m = (left_m + right_m) / 2;
  const double chord = sinc(half);
  const double chord_slope =
      std::abs(half) < 1e-4 ? -half / 6 : (std::cos(half) - chord) / (2 * half);  // by the turn
  const double c = std::cos(theta_rad + half), s = std::sin(theta_rad + half);
  arc.dx_m = centre_m * chord * c;
  arc.dy_m = centre_m * chord * s;
  arc.jacobian_turn = {centre_m * chord_slope * c - arc.dy_m / 2, centre_m * chord_slope * s + arc.dx_m / 2,
                       1};
  const Eigen::Vector3d jacobian_centre(chord * c / 2, chord * s / 2, 0);
  arc.jacobian_left = jacobian_centre - arc.jacobian_turn / b_m;
  arc.jacobian_right = jacobian_centre + arc.jacobian_turn / b_m;
  return arc;
}

/// Jacobian of the pose at the end of the arc by the pose at its beginning.
inline Eigen::Matrix3d transition(const Arc& arc) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
  f(0, 2) = -arc.dy_m;
  f(1, 2) = arc.dx_m;
  return f;
}

/// Covariance of the pose that slip along the arc causes, for K = 1 m.
inline Eigen::Matrix3d slip_per_K(const Arc& arc, double left_m, double right_m) {
  return std::abs(left_m) * arc.jacobian_left * arc.jacobian_left.transpose() +
         std::abs(right_m) * arc.jacobian_right * arc.jacobian_right.transpose();
}

/// The pose that the tracker should report for the tracked body, and its Jacobians.
struct ExpectedBody {
  Eigen::Vector3d pose;
  Eigen::Matrix3d jacobian_state = Eigen::Matrix3d::Identity(), jacobian_lever = Eigen::Matrix3d::Identity();
};

inline ExpectedBody expected_body(const Eigen::Vector3d& state, const Unknowns& u) {
  const double c = std::cos(state[2]), s = std::sin(state[2]);
  const double x = c * u[kLeverX] - s * u[kLeverY], y = s * u[kLeverX] + c * u[kLeverY];
  ExpectedBody expected;
  expected.pose = {state[0] + x, state[1] + y, state[2] + u[kLeverYaw]};
  expected.jacobian_state(0, 2) = -y;
  expected.jacobian_state(1, 2) = x;
  expected.jacobian_lever.topLeftCorner<2, 2>() << c, -s, s, c;
  return expected;
}

}  // namespace astro::calibration
