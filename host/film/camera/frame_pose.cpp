#include "host/film/camera/frame_pose.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace astro::film {
namespace {

using Eigen::Index, Eigen::Vector3d;
using Residual = Eigen::Matrix<double, 8, 1>;

}  // namespace

std::optional<FramePose> frame_pose(const Scene& scene, const TagCorners& seen, const Pose2& start,
                                    const RobotVelocity& velocity) {
  constexpr int kMostSteps = 12;
  constexpr double kStep = 1e-6, kSettled = 1e-8, kFarthest = 1.5;  // m and rad
  Vector3d at(start.x_m, start.y_m, start.theta_rad);
  const Vector3d begin = at;
  const auto residual = [&](const Vector3d& p) {
    const TagCorners model = robot_corners(scene, {p[0], p[1], p[2]}, velocity, seen);
    Residual r;
    for (std::size_t i = 0; i < 4; ++i) r.segment<2>(static_cast<Index>(2 * i)) = model[i] - seen[i];
    return r;
  };
  for (int i = 0; i < kMostSteps; ++i) {
    const Residual r = residual(at);
    Eigen::Matrix<double, 8, 3> jacobian;
    for (Index k = 0; k < 3; ++k)
      jacobian.col(k) =
          (residual(at + kStep * Vector3d::Unit(k)) - residual(at - kStep * Vector3d::Unit(k))) / (2 * kStep);
    const Eigen::Matrix3d information = jacobian.transpose() * jacobian;
    const Vector3d step = -information.ldlt().solve(jacobian.transpose() * r);
    at += step;
    if (!at.allFinite() || !((at - begin).norm() < kFarthest)) return std::nullopt;
    if (step.norm() > kSettled) continue;
    return FramePose{{at[0], at[1], at[2]}, residual(at).norm() / std::sqrt(8.0), information.inverse()};
  }
  return std::nullopt;
}

}  // namespace astro::film
