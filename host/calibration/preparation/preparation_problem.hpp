#pragma once

namespace astro::calibration {

/// Why a run cannot be used. Values: its name, if there is one; then the stream (times_missing,
/// times_run_backwards, times_jump) or the number of samples (too_little_truth).
enum class PreparationProblem {
  no_runs,
  no_odometry,
  too_little_truth,
  times_missing,
  times_run_backwards,
  times_jump,
  odometry_not_finite,
  odometry_lost,
  too_short,
  mirrored,
  mirrored_or_clockwise,
  headings_clockwise,
  heading_stays,
  positions_stay,
  nothing_in_common,
  clock_unsettled
};

}  // namespace astro::calibration
