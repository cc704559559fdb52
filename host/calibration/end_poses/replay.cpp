#include "host/calibration/end_poses/replay.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/calibration/motion/arc.hpp"

namespace astro::calibration {
EndPose replay_square(double side_m, Sense sense, const WheelFactors& odometry, const WheelFactors& truth) {
  const double right = truth.c_r / odometry.c_r;
  const double left = truth.c_l / odometry.c_l;
  const double sign = sign_of(sense);
  const double spin_m = sign * odometry.b_m * std::numbers::pi / 4;
  EndPose side;
  const auto follow = [&](double right_m, double left_m) {
    advance(side, right_m, left_m, effective_wheelbase_m(right_m, left_m, truth));
  };
  follow(side_m * right, side_m * left);
  follow(spin_m * right, -spin_m * left);
  const EndPose two_sides = side * side;
  EndPose pose = two_sides * two_sides;
  pose.theta_rad -= sign * 2 * std::numbers::pi;
  return pose;
}

double replay_E_max_syst_m(double side_m, const WheelFactors& odometry, const WheelFactors& truth) {
  const auto r_m = [&](Sense sense) {
    const EndPose error = replay_square(side_m, sense, odometry, truth);
    return std::hypot(error.x_m, error.y_m);
  };
  return std::max(r_m(Sense::cw), r_m(Sense::ccw));
}

}  // namespace astro::calibration
