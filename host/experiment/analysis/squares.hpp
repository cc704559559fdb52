#pragma once

#include <span>
#include <vector>

#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/recording/run/run.hpp"

/// From recordings to the end errors of squares, and to the factors with which they were driven.
namespace astro::experiment {

/// All squares that were driven with one set of parameters.
struct Squares {
  std::vector<calibration::EndPose> cw, ccw;
  double side_m = 0;
  calibration::WheelFactors loaded;
};

/// The squares among `runs`. Throws astro::Error if there are none, or if they differ in side or in
/// the parameters that were loaded in the robot: such runs must not be averaged.
Squares squares_of(std::span<const recording::Run> runs);

/// Whether a robot cannot tell `a` from `b`: they differ by less than the wire format resolves.
bool same_factors(const calibration::WheelFactors& a, const calibration::WheelFactors& b);

/// The factors that were loaded in a run's robot; throws astro::Error where the recording does not say.
calibration::WheelFactors loaded_factors(const recording::RunInfo& info);

/// The factors that were loaded in all runs; throws astro::Error where they differ (same_factors), or where a recording
/// does not say. Precondition: at least one run.
calibration::WheelFactors loaded_in_all(const RunSet& set);

}  // namespace astro::experiment
