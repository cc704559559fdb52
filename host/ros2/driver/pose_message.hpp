#pragma once

#include <optional>
#include <string>

#include "host/calibration/likelihood/matrix3.hpp"
#include "host/ros2/messages/geometry.hpp"

namespace astro::ros2 {

struct PlanarPose {
  double x_m = 0, y_m = 0, theta_rad = 0;
  calibration::Symmetric3 covariance;
};

/// The pose on the floor that a message sets. Throws astro::Error if there is none, it is in another frame than `frame`, holds
/// NaN or infinity, an orientation of length 0, or a covariance of (x, y, yaw) that is none.
PlanarPose planar(const std::optional<msg::PoseWithCovarianceStamped>& message, const std::string& frame);

}  // namespace astro::ros2
