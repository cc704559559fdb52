#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "host/calibration/preparation/relative_pose.hpp"

namespace astro::calibration {

/// Where the tracked body sits on the robot, estimated from one drive.
struct Mounting {
  LeverArm lever;
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Identity();  // of x, y, yaw; large where the drive does not determine them
};

/// Linear least squares for given turn rates of the wheels: the displacements of the body are linear in the lever arm and in
/// cosine and sine of its yaw. Cosine and sine are not forced onto the unit circle, so a small error of the wheels' sizes
/// scales both of them and changes neither the lever arm nor the yaw.
///
/// Returns nothing if the pieces have hardly any displacement, because only displacement shows the yaw.
std::optional<Mounting> mounting_of(std::span<const RelativePose> pieces, const TurnRates& rates);

}  // namespace astro::calibration
