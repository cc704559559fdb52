#pragma once

#include <string>
#include <vector>

#include "host/base/remedy.hpp"
#include "host/experiment/analysis/calibration.hpp"

/// What maximum likelihood found beside the factors, in sentences for a person: terminal and report say the
/// same.
namespace astro::experiment {

/// Runs, distance and turning that it was found from.
std::string extent_sentence(const MlResult& ml);

/// Where the tracked body sits on the robot.
std::string lever_sentence(const MlResult& ml);

/// Whose clock the truth has, and what was found about it.
std::string clock_sentence(const MlResult& ml);

/// What was taken for noise, given or estimated, and how well it explains the runs.
std::string noise_sentence(const MlResult& ml);

/// What does not fit, or the one sentence that everything does. Without the final stops.
std::vector<Remark> verdict(const MlResult& ml);

/// "1.23 ± 0.45": two digits of the error, `decimals` where it is not known.
std::string with_error(double value, double error, int decimals);

}  // namespace astro::experiment
