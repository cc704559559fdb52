#include "host/calibration/preparation/path_alignment.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibration/motion/arc.hpp"
#include "host/calibration/motion/wheel_path.hpp"

namespace astro::calibration {

std::vector<WheelStep> wheel_steps(const WheelPath& path, double from_s, double to_s) {
  const int count = std::max(1, static_cast<int>(std::ceil((to_s - from_s) / kLongestStep_s)));
  std::vector<WheelStep> steps;
  WheelState before = path.at(from_s);
  for (int i = 1; i <= count; ++i) {
    const WheelState now = path.at(from_s + (to_s - from_s) * i / count);
    steps.push_back({now.left_m - before.left_m, now.right_m - before.right_m});
    before = now;
  }
  return steps;
}

std::vector<BodySample> dead_reckoned(const PreparedRun& run, const ClockFit& clock,
                                      const WheelFactors& factors) {
  const WheelPath path(run.source->wheels);
  std::vector<BodySample> poses;
  BodySample pose{0, 0, 0, 0};
  double before_s = 0;
  for (const BodySample& sample : run.truth) {
    const double now_s = clock.robot_time_s(sample.time_s, run.clock_middle_s);
    if (!poses.empty())
      for (const WheelStep& step : wheel_steps(path, before_s, now_s))
        advance(pose, step.right, step.left, factors);
    pose.time_s = sample.time_s;
    poses.push_back(pose);
    before_s = now_s;
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
  RigidFit fit;
  fit.rotation_rad = std::atan2(cross, dot);
  const double c = std::cos(fit.rotation_rad), s = std::sin(fit.rotation_rad);
  fit.x_m = tx - (c * fx - s * fy);
  fit.y_m = ty - (s * fx + c * fy);
  fit.rms_m = std::sqrt(std::max(0.0, spread - 2 * std::hypot(dot, cross)) / n);
  return fit;
}

}  // namespace astro::calibration
