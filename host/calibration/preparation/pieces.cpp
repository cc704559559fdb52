#include "host/calibration/preparation/pieces.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "host/calibration/preparation/path_alignment.hpp"

namespace astro::calibration {
namespace {

constexpr double kLeast_m = 0.3, kLeast_rad = 0.5;
// During a gap of the tracker the robot may have turned by more than half a turn.
constexpr double kSurely_rad = 2.5;

RelativePose closed_piece(const BodySample& from, const BodySample& to, std::vector<WheelStep> steps) {
  const double dx = to.x_m - from.x_m, dy = to.y_m - from.y_m;
  const double c = std::cos(from.theta_rad), s = std::sin(from.theta_rad);
  return {std::move(steps), c * dx + s * dy, c * dy - s * dx,
          std::remainder(to.theta_rad - from.theta_rad, 2 * std::numbers::pi)};
}

}  // namespace

std::vector<RelativePose> pieces_of(const PreparedRun& run, const ClockFit& clock, double wheelbase_m) {
  std::vector<RelativePose> pieces;
  if (run.truth.empty()) return pieces;
  const auto robot_s = [&](std::size_t i) {
    return clock.robot_time_s(run.truth[i].time_s, run.clock_middle_s);
  };
  WheelWalk walk(run.source->wheels, robot_s(0));
  std::vector<WheelStep> steps;
  std::size_t from = 0;
  double travelled_m = 0, turned_rad = 0;
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    walk.go(robot_s(i), [&](const WheelStep& step) {
      steps.push_back(step);
      travelled_m += (step.left + step.right) / 2;
      turned_rad += (step.right - step.left) / wheelbase_m;
    });
    if (std::abs(travelled_m) < kLeast_m && std::abs(turned_rad) < kLeast_rad) continue;
    if (std::abs(turned_rad) < kSurely_rad)
      pieces.push_back(closed_piece(run.truth[from], run.truth[i], std::move(steps)));
    steps.clear();
    from = i;
    travelled_m = turned_rad = 0;
  }
  return pieces;
}

}  // namespace astro::calibration
