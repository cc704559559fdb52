#pragma once

#include <optional>
#include <span>
#include <string>

#include "host/calibration/end_poses/end_pose.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/recording/run/run.hpp"

namespace astro::experiment {

/// Where a run of the plan ended in contrast to where odometry says.
struct RunEnd {
  RunSpec spec;
  calibration::EndPose error;  // NaN where it cannot be computed; then the calibration reports why
};

RunEnd run_end(const RunSpec& spec, const recording::Run& run);

struct MistypedSquare {
  std::string why;  // names the run, its value and that of the others
  RunSpec spec;
};

/// Whether the ground truth of a square looks mistyped compared with the others
/// (host/calibration/end_poses/odd_run.hpp). The last of `ends` is the new run; among the others, the squares of
/// its phase and direction count. Nothing if it is no square.
std::optional<MistypedSquare> mistyped_square(std::span<const RunEnd> ends, double side_m);

}  // namespace astro::experiment
