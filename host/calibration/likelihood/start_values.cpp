#include "host/calibration/likelihood/start_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "host/base/error.hpp"
#include "host/calibration/motion/tracker_noise.hpp"
#include "host/calibration/motion/wheel_path.hpp"
#include "host/calibration/preparation/path_alignment.hpp"
#include "host/calibration/preparation/position_lever.hpp"
#include "host/calibration/preparation/relative_pose.hpp"

namespace astro::calibration {
namespace {

// A piece is long enough to exceed the tracker's noise, and short enough that there are many pieces.
constexpr double kPiece_m = 0.3, kPiece_rad = 0.5;
constexpr double kStretch_m = 1;
constexpr double kLeastTurn_rad = 1;
constexpr double kTypicalK_m = 2.6e-6;

RelativePose closed_piece(const BodySample& from, const BodySample& to, std::vector<WheelStep> steps) {
  const double dx = to.x_m - from.x_m, dy = to.y_m - from.y_m;
  const double c = std::cos(from.theta_rad), s = std::sin(from.theta_rad);
  return {std::move(steps), c * dx + s * dy, c * dy - s * dx,
          std::remainder(to.theta_rad - from.theta_rad, 2 * std::numbers::pi)};
}

void add_pieces(const PreparedRun& run, const ClockFit& clock, double wheelbase_m,
                std::vector<RelativePose>& pieces) {
  const WheelPath path(run.source->wheels);
  std::vector<WheelStep> steps;
  std::size_t from = 0;
  double travelled_m = 0, turned_rad = 0, before_s = 0;
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const double now_s = clock.robot_time_s(run.truth[i].time_s, run.clock_middle_s);
    if (i > 0)
      for (const WheelStep& step : wheel_steps(path, before_s, now_s)) {
        steps.push_back(step);
        travelled_m += (step.left + step.right) / 2;
        turned_rad += (step.right - step.left) / wheelbase_m;
      }
    before_s = now_s;
    if (std::abs(travelled_m) < kPiece_m && std::abs(turned_rad) < kPiece_rad) continue;
    // During a gap of the tracker the robot may have turned by more than half a turn.
    if (std::abs(turned_rad) < 2.5)
      pieces.push_back(closed_piece(run.truth[from], run.truth[i], std::move(steps)));
    steps.clear();
    from = i;
    travelled_m = turned_rad = 0;
  }
}

std::optional<RelativePoseFit> closed_form(const PreparedRuns& runs, const WheelFactors& loaded) {
  std::vector<RelativePose> pieces;
  for (std::size_t i = 0; i < runs.runs.size(); ++i)
    if (runs.runs[i].has_headings) add_pieces(runs.runs[i], runs.clocks[i], loaded.b_m, pieces);
  return fit_relative_poses_trimmed(pieces, 2, 0.02);
}

void require_forward(const RelativePoseFit& fit) {
  for (const auto& [wheel, radius] : {std::pair{"left", fit.r_left}, std::pair{"right", fit.r_right}})
    if (!(radius > 0))
      throw Error(
          fmt::format("the {} wheel comes out turning backwards: its encoder or its motor is reversed",
                      wheel),
          {Help::check_wiring});
}

/// The path of the tracked body by dead reckoning over a first stretch, which is so short that wrong factors
/// hardly bend it.
std::vector<BodySample> first_stretch(std::vector<BodySample> robot, const Unknowns& u) {
  double travelled_m = 0;
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const double c = std::cos(robot[i].theta_rad), s = std::sin(robot[i].theta_rad);
    robot[i].x_m += c * u[kLeverX] - s * u[kLeverY];
    robot[i].y_m += s * u[kLeverX] + c * u[kLeverY];
    if (i > 0) travelled_m += std::hypot(robot[i].x_m - robot[i - 1].x_m, robot[i].y_m - robot[i - 1].y_m);
    if (travelled_m > kStretch_m) robot.resize(i + 1);
  }
  return robot;
}

void place_start(const PreparedRun& run, const ClockFit& clock, const WheelFactors& factors, Unknowns& u) {
  u[kClockOffset] = clock.offset_s;
  if (run.has_headings) {
    const BodySample& first = run.truth.front();
    u[kStartTheta] = first.theta_rad - u[kLeverYaw];
    const double c = std::cos(u[kStartTheta]), s = std::sin(u[kStartTheta]);
    u[kStartX] = first.x_m - c * u[kLeverX] + s * u[kLeverY];
    u[kStartY] = first.y_m - s * u[kLeverX] - c * u[kLeverY];
    return;
  }
  const std::vector<BodySample> body = first_stretch(dead_reckoned(run, clock, factors), u);
  const RigidFit fit = fit_rigid(body, std::span(run.truth).first(body.size()), false);
  u[kStartTheta] = fit.rotation_rad;
  u[kStartX] = fit.x_m;
  u[kStartY] = fit.y_m;
}

}  // namespace

void require_variety(const PreparedRuns& runs) {
  double distance_m = 0, rotation_rad = 0;
  for (const PreparedRun& run : runs.runs) {
    distance_m += run.distance_m;
    rotation_rad += run.rotation_rad;
  }
  if (rotation_rad < kLeastTurn_rad)
    throw Error("the robot never turned, so its wheelbase cannot be determined", {Help::drive_turns});
  if (distance_m < 0.02 * rotation_rad)
    throw Error(
        "the robot only turned on the spot, which determines the ratio of wheels and wheelbase but no size",
        {Help::drive_lines});
}

std::vector<Unknowns> start_values(const PreparedRuns& runs, const WheelFactors& loaded) {
  Unknowns shared = Unknowns::Zero();
  shared[kCRight] = loaded.c_r;
  shared[kCLeft] = loaded.c_l;
  shared[kB] = loaded.b_m;
  for (const ClockFit& clock : runs.clocks)
    shared[kSkew] += clock.skew / static_cast<double>(runs.clocks.size());
  if (const auto fit = closed_form(runs, loaded)) {
    require_forward(*fit);
    shared[kCRight] = fit->r_right;
    shared[kCLeft] = fit->r_left;
    shared[kB] = fit->b_m;
    shared[kLeverX] = fit->sensor.x_m;
    shared[kLeverY] = fit->sensor.y_m;
    shared[kLeverYaw] = fit->sensor.yaw_rad;
  } else if (const auto lever = lever_of_positions(runs, loaded)) {
    shared[kLeverX] = lever->x_m;
    shared[kLeverY] = lever->y_m;
  }
  std::vector<Unknowns> all(runs.runs.size(), shared);
  for (std::size_t i = 0; i < all.size(); ++i)
    place_start(runs.runs[i], runs.clocks[i], {shared[kCRight], shared[kCLeft], shared[kB]}, all[i]);
  return all;
}

NoiseModel start_noise(const PreparedRuns& runs) {
  SecondDifferences differences;
  for (const PreparedRun& run : runs.runs) differences.add(run.source->truth);
  return {kTypicalK_m, std::max(differences.sigma_xy_m(), 1e-5),
          std::max(differences.sigma_theta_rad(), 1e-5)};
}

}  // namespace astro::calibration
