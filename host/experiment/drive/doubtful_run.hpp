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

/// Those among the runs of a phase, the most doubtful first: squares that do not fit the others
/// (host/calibration/end_poses/odd_run.hpp), and lines that are 3 % longer or shorter than the others or, of the first two,
/// than odometry says. Earlier runs are judged as well as the last one: which of them is wrong may show only later.
///
/// Precondition  specs[i] is what was planned for runs[i], and all are of one phase.
std::vector<DoubtfulRun> doubtful_runs(std::span<const RunSpec> specs, std::span<const recording::Run> runs);

}  // namespace astro::experiment
