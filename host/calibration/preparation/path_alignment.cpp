#include "host/calibration/preparation/path_alignment.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibration/motion/arc.hpp"

namespace astro::calibration {

std::vector<BodySample> dead_reckoned(const PreparedRun& run, const ClockFit& clock,
                                      const WheelFactors& factors) {
  std::vector<BodySample> poses;
  if (run.truth.empty()) return poses;
  poses.reserve(run.truth.size());
  const auto robot_s = [&](const BodySample& sample) {
    return clock.robot_time_s(sample.time_s, run.clock_middle_s);
  };
  WheelWalk walk(run.source->wheels, robot_s(run.truth.front()));
  Pose2 pose;
  for (const BodySample& sample : run.truth) {
    if (!poses.empty())
      walk.go(robot_s(sample), [&](const WheelStep& step) { advance(pose, step.right, step.left, factors); });
    poses.push_back({sample.time_s, pose.x_m, pose.y_m, pose.theta_rad});
  }
  return poses;
}

RigidFit fit_rigid(std::span<const BodySample> from, std::span<const BodySample> to, bool mirrored) {
  const double sign = mirrored ? -1 : 1, n = static_cast<double>(from.size());
  double fx = 0, fy = 0, tx = 0, ty = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    fx += from[i].x_m / n;
    fy += sign * from[i].y_m / n;
    tx += to[i].x_m / n;
    ty += to[i].y_m / n;
  }
  double dot = 0, cross = 0, spread = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double ax = from[i].x_m - fx, ay = sign * from[i].y_m - fy, bx = to[i].x_m - tx,
                 by = to[i].y_m - ty;
    dot += ax * bx + ay * by;
    cross += ax * by - ay * bx;
    spread += ax * ax + ay * ay + bx * bx + by * by;
  }
  const double rotation_rad = std::atan2(cross, dot);
  const Point2 middle = Point2{fx, fy}.turned(rotation_rad);
  return {{tx - middle.x_m, ty - middle.y_m, rotation_rad},
          std::sqrt(std::max(0.0, spread - 2 * std::hypot(dot, cross)) / n)};
}

}  // namespace astro::calibration
