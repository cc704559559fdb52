#pragma once

namespace astro::calibration {

/// Why the runs together do not determine the factors. Values of wheelbase_unlike: the wheelbase that came out, and the loaded
/// one, in metres.
enum class LikelihoodProblem {
  wheel_turns_backwards,
  never_turned,
  only_spun,
  all_move_alike,
  implausible_factors,
  stamps_or_resolution,
  wheelbase_unlike
};

}  // namespace astro::calibration
