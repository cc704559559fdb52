#include "host/calibration/preparation/handedness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/text/degrees.hpp"
#include "host/calibration/preparation/path_alignment.hpp"
#include "host/calibration/preparation/preparation_problem.hpp"

namespace astro::calibration {
namespace {

// Steps of heading that exceed the noise and are far below half a turn.
constexpr double kStep_s = 0.2, kLargestStep_rad = 2.5;
// Relative to the turning of the wheels: a body on the robot turns by more, even if a wheel is twice its
// nominal size.
constexpr double kLeastSlope = 0.2;

/// Rotation of truth per rotation by the wheels, by least squares, which averages the noise of headings.
double heading_slope(const PreparedRun& run, const std::vector<BodySample>& odometry) {
  double product = 0, square = 0;
  for (std::size_t i = 0, from = 0; i < run.truth.size(); ++i) {
    if (run.truth[i].time_s - run.truth[from].time_s < kStep_s) continue;
    const double truth = wrapped_rad(run.truth[i].theta_rad - run.truth[from].theta_rad);
    const double wheels = odometry[i].theta_rad - odometry[from].theta_rad;
    from = i;
    if (std::abs(wheels) > kLargestStep_rad) continue;  // a long gap
    product += truth * wheels;
    square += wheels * wheels;
  }
  return square > 0 ? product / square : 1;
}

enum class Positions { agree, oppose, silent };

Positions handedness_of_positions(const PreparedRun& run, const std::vector<BodySample>& odometry) {
  // A line is its own mirror image, and a spin on the spot nearly so: they do not decide.
  if (run.distance_m < 1) return Positions::silent;
  const double straight_m = fit_rigid(odometry, run.truth, false).rms_m;
  const double mirrored_m = fit_rigid(odometry, run.truth, true).rms_m;
  if (straight_m > 0.05 && mirrored_m < straight_m / 3) return Positions::oppose;
  return mirrored_m > 0.05 && straight_m < mirrored_m / 3 ? Positions::agree : Positions::silent;
}

[[noreturn]] void refuse_opposite_turn(const std::string& name, Positions positions) {
  if (positions == Positions::agree)
    throw Error(
        name +
            ": the headings of the ground truth turn right where its positions and the wheels turn left: "
            "they are clockwise; negate them",
        PreparationProblem::headings_clockwise, {name});
  const bool silent = positions == Positions::silent;
  throw Error(
      name + fmt::format(
                 ": the ground truth turns right where the wheels say left: its axes are mirrored (a Y-up "
                 "export has x = Z, y = X), {}or the left and right wheels are exchanged",
                 silent ? "its headings are clockwise, " : ""),
      silent ? PreparationProblem::mirrored_or_clockwise : PreparationProblem::mirrored, {name});
}

/// A drive's turn by the wheels and by its measured ends, of which the latter is known up to whole turns.
struct Turn {
  double wheels_rad, ends_rad;
};

/// By how much the turns differ if those of the wheels are `sign` times what they seem, with the wheelbase that fits best.
double misfit_rad(const std::vector<Turn>& turns, double sign) {
  constexpr double kLeast = 0.85, kMost = 1.18, kStep = 0.002;  // of the nominal turn
  double least = HUGE_VAL;
  for (double scale = kLeast; scale < kMost; scale += kStep) {
    double sum = 0;
    for (const Turn& turn : turns)
      sum += std::pow(wrapped_rad(turn.ends_rad - sign * scale * turn.wheels_rad), 2);
    least = std::min(least, sum);
  }
  return std::sqrt(least / static_cast<double>(turns.size()));
}

}  // namespace

void require_handedness_of_ends(std::span<const PreparedRun> runs, const WheelFactors& loaded) {
  constexpr std::size_t kFewest = 3;
  // Far above the errors of headings that a person reads, and a third of what turns that have nothing in common differ by.
  constexpr double kWrong_rad = 0.35, kBetter = 3;
  std::vector<Turn> turns;
  const Trajectory* first = nullptr;
  for (const PreparedRun& run : runs) {
    if (!run.source->ends_only || !run.has_headings) continue;
    const WheelSample &from = run.source->wheels.front(), &to = run.source->wheels.back();
    const double right_m = loaded.c_r * (to.right_m - from.right_m),
                 left_m = loaded.c_l * (to.left_m - from.left_m);
    turns.push_back(
        {(right_m - left_m) / loaded.b_m, run.truth.back().theta_rad - run.truth.front().theta_rad});
    if (first == nullptr) first = run.source;
  }
  if (turns.size() < kFewest) return;
  const double as_they_are = misfit_rad(turns, 1);
  if (as_they_are < kWrong_rad || misfit_rad(turns, -1) > as_they_are / kBetter) return;
  throw Error(
      first->name +
          " and the other drives end turned as if the wheels turned the other way: the left and right "
          "wheels are exchanged, or the headings are clockwise, or the axes mirrored",
      PreparationProblem::mirrored_or_clockwise, {first->name});
}

void require_handedness(const PreparedRun& run, const ClockFit& clock, const WheelFactors& loaded) {
  if (run.rotation_rad < 1) return;
  const std::vector<BodySample> odometry = dead_reckoned(run, clock, loaded);
  const Positions positions = handedness_of_positions(run, odometry);
  if (run.has_headings) {
    const double slope = heading_slope(run, odometry);
    if (slope < -kLeastSlope) refuse_opposite_turn(run.source->name, positions);
    if (slope < kLeastSlope)
      throw Error(
          fmt::format(
              "{}: the wheels turned the robot by {:.0f} degrees and the heading of the ground truth "
              "stayed: it has no orientation of the body, or the robot did not turn and an encoder or a "
              "motor is reversed",
              run.source->name, degrees(run.rotation_rad)),
          PreparationProblem::heading_stays, {run.source->name});
  }
  if (positions == Positions::oppose) refuse_opposite_turn(run.source->name, positions);
}

}  // namespace astro::calibration
