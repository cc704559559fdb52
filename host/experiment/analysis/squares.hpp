#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/recording/run/run.hpp"

/// From recordings to the end errors of squares.
namespace astro::experiment {

/// All squares that were driven with one set of parameters.
struct Squares {
  std::vector<calibration::EndPose> cw, ccw;
  double side_m = 0;
  calibration::WheelFactors carried;
};

/// Picks the squares out of `runs`. Throws astro::Error if there are none, or if they differ in side or in
/// the parameters that the robot carried: such runs cannot be averaged.
Squares squares_of(std::span<const recording::Run> runs);

/// Their end errors, if both directions were driven and all alike; none otherwise, which is no error: for
/// what is found without squares and only shown with them.
std::optional<calibration::ExperimentSummary> summary_of_squares(std::span<const recording::Run> runs);

/// Whether a robot that carries `a` carries `b`: within what the wire format rounds off.
bool same_factors(const calibration::WheelFactors& a, const calibration::WheelFactors& b);

/// The factors that a run's robot carried; throws astro::Error where the recording does not say.
calibration::WheelFactors carried_factors(const recording::RunInfo& info);

}  // namespace astro::experiment
