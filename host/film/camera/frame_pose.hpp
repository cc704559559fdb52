#pragma once

#include <Eigen/Core>
#include <optional>

#include "host/film/camera/scene.hpp"

namespace astro::film {

/// For the four corners of a tag: x and y in pixels, where the model sees them minus where they were seen.
using CornerResidual = Eigen::Matrix<double, 8, 1>;
CornerResidual residual_px(const TagCorners& model, const TagCorners& seen);

/// The robot's tag in one picture of a scene, as a function of its pose (m, m, rad).
struct PoseMisfit {
  const Scene& scene;
  const TagCorners& seen;
  RobotVelocity velocity;

  CornerResidual operator()(const Pose2& pose) const {
    return residual_px(robot_corners(scene, pose, velocity, seen), seen);
  }
  /// The Jacobian, by central differences.
  Eigen::Matrix<double, 8, 3> jacobian(const Pose2& pose) const;
};

/// The pose with (x, y, theta) changed by `step`.
Pose2 stepped(const Pose2& pose, const Eigen::Vector3d& step);

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
