#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "host/calibration/preparation/relative_pose.hpp"

namespace astro::calibration {

/// Where the tracked body sits on the robot, as one drive shows it.
struct Mounting {
  LeverArm lever;
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Identity();  // of x, y, yaw; wide in a direction that the drive does not show
};

/// By linear least squares with the turn rates of the wheels given: the displacements of the body are linear in the lever arm and
/// in cosine and sine of its yaw. These are not forced onto the unit circle, so that wheels of a slightly wrong size
/// shorten both, and neither the lever arm nor the yaw.
///
/// Nothing without displacement, which is what shows the yaw.
std::optional<Mounting> mounting_of(std::span<const RelativePose> pieces, const TurnRates& rates);

}  // namespace astro::calibration
