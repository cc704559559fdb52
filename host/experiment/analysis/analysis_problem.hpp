#pragma once

namespace astro::experiment {

/// What keeps recordings or a calibration from being used. Values: the run's name, or the folder of no_phase_complete.
enum class AnalysisProblem {
  no_squares,
  end_poses_only,
  run_unusable,
  run_without_truth,
  no_phase_complete,
  no_calibration,
  no_wheel_separation,
  no_wheel_radius
};

}  // namespace astro::experiment
