#pragma once

#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/experiment/analysis/calibration.hpp"

/// What maximum likelihood found beside the factors, in sentences that the terminal and the report share.
namespace astro::experiment {

/// The number of runs, their distance and their rotation.
std::string extent_sentence(const MlResult& ml);

/// The lever arm of the tracked body, in each session.
std::string lever_sentence(const MlResult& ml);

/// The clock of the truth: known, or its skew.
std::string clock_sentence(const MlResult& ml);

/// How well the scale of the ground truth is known; "" where it is taken for exact. Precondition: found by maximum likelihood.
std::string scale_sentence(const Calibration& found);

/// Whether gentle arcs turn about another wheelbase than spins: as a fact, as perhaps, or not (two_wheelbases), and how wrong odometry
/// with one wheelbase would be. Precondition: found by maximum likelihood.
std::string wheelbase_sentence(const Calibration& found);

/// "spins turn about b = 290.000 mm, gentle arcs about b (1 + e) = 298.700 mm".
std::string wheelbases_text(const calibration::WheelFactors& factors);

/// The noise, given or estimated, how well it explains the runs, and wheels that run out of true.
std::string noise_sentence(const MlResult& ml);

/// What does not fit, or one sentence that everything fits. Without final full stops.
std::vector<Remark> verdict(const MlResult& ml);

/// As many as show two digits of the error; `decimals` where it is not known.
int decimals_by(double error, int decimals);

/// "1.23 ± 0.45": two digits of the error, `decimals` where it is not known.
std::string with_error(double value, double error, int decimals);

}  // namespace astro::experiment
