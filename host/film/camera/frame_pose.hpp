#pragma once

#include <Eigen/Core>
#include <optional>

#include "host/film/camera/scene.hpp"

namespace astro::film {

struct FramePose {
  Pose2 pose;
  double rms_px = 0;  // of the corners' residuals, per coordinate
  Eigen::Matrix3d cofactor =
      Eigen::Matrix3d::Zero();  // the covariance of (x, y, theta) for corners with a standard error of 1 px
};

/// Finds the pose of the robot's tag in one picture of a known scene. Nothing if the iteration does not
/// converge.
/// Precondition  `start` is right to within some centimetres and 0.3 rad.
std::optional<FramePose> frame_pose(const Scene& scene, const TagCorners& seen, const Pose2& start,
                                    const RobotVelocity& velocity);

}  // namespace astro::film
