#pragma once

namespace astro::calibration {

/// Why the runs together do not determine the factors.
enum class LikelihoodProblem {
  wheel_turns_backwards,
  never_turned,
  only_spun,
  all_move_alike,
  implausible_factors
};

}  // namespace astro::calibration
