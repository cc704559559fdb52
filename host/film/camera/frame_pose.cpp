#include "host/film/camera/frame_pose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace astro::film {

using Eigen::Index, Eigen::Vector3d;

CornerResidual residual_px(const TagCorners& model, const TagCorners& seen) {
  CornerResidual r;
  for (std::size_t i = 0; i < 4; ++i) r.segment<2>(static_cast<Index>(2 * i)) = model[i] - seen[i];
  return r;
}

Pose2 stepped(const Pose2& pose, const Vector3d& step) {
  return {pose.x_m + step[0], pose.y_m + step[1], pose.theta_rad + step[2]};
}

Eigen::Matrix<double, 8, 3> PoseMisfit::jacobian(const Pose2& pose) const {
  constexpr double kStep = 1e-6;  // m and rad
  Eigen::Matrix<double, 8, 3> jacobian;
  for (Index i = 0; i < 3; ++i) {
    const Vector3d step = kStep * Vector3d::Unit(i);
    jacobian.col(i) = ((*this)(stepped(pose, step)) - (*this)(stepped(pose, -step))) / (2 * kStep);
  }
  return jacobian;
}

std::optional<FramePose> frame_pose(const Scene& scene, const TagCorners& seen, const Pose2& start,
                                    const RobotVelocity& velocity) {
  constexpr int kMostSteps = 12;
  constexpr double kSettled = 1e-8, kFarthest = 1.5;  // m and rad
  const PoseMisfit misfit{scene, seen, velocity};
  Pose2 at = start;
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Matrix<double, 8, 3> jacobian = misfit.jacobian(at);
    const Eigen::Matrix3d information = jacobian.transpose() * jacobian;
    const Vector3d step = -information.ldlt().solve(jacobian.transpose() * misfit(at));
    at = stepped(at, step);
    const Vector3d moved(at.x_m - start.x_m, at.y_m - start.y_m, at.theta_rad - start.theta_rad);
    if (!(moved.norm() < kFarthest)) return std::nullopt;  // written so that a NaN ends it, too
    if (step.norm() > kSettled) continue;
    return FramePose{at, misfit(at).norm() / std::sqrt(8.0), information.inverse()};
  }
  return std::nullopt;
}

}  // namespace astro::film
