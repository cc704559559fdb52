#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/experiment/files/plan.hpp"
#include "host/recording/run.hpp"

namespace astro::experiment {

/// A run whose measured end does not fit the other runs.
struct DoubtfulRun {
  RunSpec spec;
  std::string why;  // names the run, what was measured, what was expected, and what would fit
};

/// The doubtful runs of a phase: first the squares that do not fit the others (host/calibration/end_poses/odd_run.hpp), the
/// most doubtful first, then the lines that are more than 3 % longer or shorter than the others or, if fewer than two others
/// agree, than odometry says. Earlier runs are checked as well as the last one, because later runs may show which of them is
/// wrong.
///
/// Precondition  specs[i] is what was planned for runs[i], and all are of one phase.
std::vector<DoubtfulRun> doubtful_runs(std::span<const RunSpec> specs, std::span<const recording::Run> runs);

}  // namespace astro::experiment
