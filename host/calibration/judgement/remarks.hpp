#pragma once

#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"

namespace astro::calibration {

/// What may spoil a calibration. Values: of run_stands_out and run_slipped the run; then for each slip the
/// seconds since the run's start, and the degrees.
enum class JudgementProblem {
  too_few_squares,
  single_line,
  run_stands_out,
  run_slipped,
  given_noise_is_wrong,
  estimated_noise_is_wrong
};

/// One sentence for each thing that does not fit about an estimate; empty if everything fits. `noise_given`: the noise model
/// was given (MlOptions::noise) and not estimated.
std::vector<Remark> remarks(const MlEstimate& estimate, bool noise_given = false);

}  // namespace astro::calibration
