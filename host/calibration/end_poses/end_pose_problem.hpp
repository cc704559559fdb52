#pragma once

namespace astro::calibration {

/// Why end poses give no factors. Values: the direction, if it has a name (no_run, one_direction_only,
/// no_headings); the run (not_finite); the direction and the number of the run in it (no_heading,
/// heading_beyond_half_a_turn, the latter with the heading in radians); the numbers (all that are bad or implausible);
/// the mistakes (misfit_with_mistake).
enum class EndPoseProblem {
  no_runs,
  no_run,
  one_direction_only,
  not_finite,
  no_headings,
  no_heading,
  heading_beyond_half_a_turn,
  bad_side,
  bad_wheelbase,
  bad_wheel_factors,
  no_ratios_fit,
  implausible_ratios,
  implausible_scale,
  same_runs,
  misfit_with_mistake,
  misfit
};

}  // namespace astro::calibration
