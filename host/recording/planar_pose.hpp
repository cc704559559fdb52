#pragma once

#include <cmath>
#include <numbers>

namespace astro::recording {

/// A pose in the plane; theta counter-clockwise, wrapped or not as its source says.
struct PlanarPose {
  double x_m = 0, y_m = 0, theta_rad = 0;
};

/// The same angle in [-pi, pi]. NaN stays NaN.
inline double wrapped_rad(double angle_rad) { return std::remainder(angle_rad, 2 * std::numbers::pi); }

/// `pose` in the frame `frame`: frame^-1 * pose. Headings are subtracted, not wrapped.
inline PlanarPose in_frame_of(const PlanarPose& frame, const PlanarPose& pose) {
  const double dx_m = pose.x_m - frame.x_m;
  const double dy_m = pose.y_m - frame.y_m;
  const double c = std::cos(frame.theta_rad);
  const double s = std::sin(frame.theta_rad);
  return {c * dx_m + s * dy_m, c * dy_m - s * dx_m, pose.theta_rad - frame.theta_rad};
}

}  // namespace astro::recording
