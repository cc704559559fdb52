#include "host/calibration/preparation/handedness.hpp"

#include <fmt/format.h>

#include <cmath>

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

}  // namespace

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
