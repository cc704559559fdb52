#pragma once

namespace astro::calibration {

/// Why a run cannot be used. Values: its name, if there is one; then the stream (times_missing,
/// times_run_backwards, times_jump), the number of samples (too_little_truth, too_little_odometry, hardly_overlap), how many
/// gaps there are and their seconds (odometry_bridged), the seconds from sample to sample (odometry_seldom), or the stream and
/// the seconds by which and at which its clock stepped (clock_stepped); where no stamp shows the step (clock_step_hidden), by
/// how many seconds and between which.
enum class PreparationProblem {
  no_runs,
  no_odometry,
  too_little_truth,
  too_little_odometry,
  times_missing,
  times_run_backwards,
  times_jump,
  odometry_not_finite,
  odometry_lost,
  odometry_bridged,
  odometry_seldom,
  hardly_overlap,
  too_short,
  mirrored,
  mirrored_or_clockwise,
  headings_clockwise,
  heading_stays,
  positions_stay,
  nothing_in_common,
  clock_unsettled,
  clock_stepped,
  clock_step_hidden
};

}  // namespace astro::calibration
