#pragma once

namespace astro::experiment {

/// What keeps recordings or a calibration from being used.
enum class AnalysisProblem {
  no_squares,
  squares_of_different_factors,
  squares_of_different_sizes,  // values: both sides in metres
  runs_of_different_factors,   // values: a run, and one with other factors
  runs_of_different_robots,    // values: a run of each
  runs_of_different_wheels,    // values: a run of each
  end_poses_only,
  no_odometry,           // value: the run's name
  times_run_backwards,   // values: the run's name, and the stream
  file_lacks_parameter,  // values: the run's name, and the parameter
  run_lacks_parameter,   // the same if the run's file is not known; values: its title, and the parameter
  run_without_truth,     // value: the run's name
  no_truth,              // in any run
  only_some_have_scans,  // values: the name of a run with scans, and of one without
  no_phase_complete,     // value: the experiment's folder
  no_calibration,  // values: the factor that is missing, and the file if it is known; no values for a folder
  factors_of_other_wheel,  // value: the file
  no_wheel_separation,
  no_wheel_radius,
  clocks_run_apart  // values: the run's name, and by how many parts in a million
};

}  // namespace astro::experiment
