#pragma once

namespace astro::experiment {

/// What is wrong with recordings that are to be calibrated together.
enum class RunSetProblem {
  same_recording,  // value: the run to leave out
  no_such_name,    // values: the name, and those that there are
  ambiguous_name   // values: the name, and those that it may be
};

}  // namespace astro::experiment
