#pragma once

#include <cmath>

/// The arc of constant twist: the motion of a robot between two samples of its wheels.
namespace astro::calibration {

/// The longest time that one arc covers, also in gaps of truth.
inline constexpr double kLongestStep_s = 0.06;

/// sin(a) / a, without the division where it would lose digits.
inline double sinc(double a) { return std::abs(a) < 1e-4 ? 1 - a * a / 6 : std::sin(a) / a; }

/// Moves `pose` (x_m, y_m, theta_rad; not wrapped) along the arc that the two wheel travels give on wheelbase
/// b. Exact while the ratio of the wheels' speeds does not change. Source  Chong & Kleeman 1997.
template <class Pose>
void advance(Pose& pose, double right_m, double left_m, double b_m) {
  const double half_turn = (right_m - left_m) / b_m / 2;
  const double chord_m = (right_m + left_m) / 2 * sinc(half_turn);
  pose.x_m += chord_m * std::cos(pose.theta_rad + half_turn);
  pose.y_m += chord_m * std::sin(pose.theta_rad + half_turn);
  pose.theta_rad += 2 * half_turn;
}

}  // namespace astro::calibration
