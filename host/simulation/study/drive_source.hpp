#pragma once

#include <vector>

#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/simulation/study/setup.hpp"

/// Where a study's drives come from: the robot that it is about.
namespace astro::simulation::study {

/// The squares of a trial in the order of driving, as each kind of method is given them.
struct Drives {
  std::vector<calibration::Trajectory> runs;     // whole, for maximum likelihood
  std::vector<calibration::EndPose> end_errors;  // of each run, for UMBmark and its kin
};

/// A robot that drives the squares of a set-up. Both calls are made by several threads at once, and what they
/// return depends on their arguments alone, to the last bit.
class DriveSource {
 public:
  DriveSource() = default;
  DriveSource(const DriveSource&) = delete;
  DriveSource& operator=(const DriveSource&) = delete;
  virtual ~DriveSource() = default;

  /// Throws astro::Error naming what of the set-up this robot cannot drive, also where TrialSetup::check
  /// does.
  virtual void check(const TrialSetup& setup) const = 0;

  /// Those of one trial. Throws astro::Error if the robot does not come through.
  virtual Drives of_trial(const TrialSetup& setup, int trial) const = 0;

  /// Without slip and without error of the ground truth, on equal clocks: what the Cramer-Rao bound is
  /// computed from. Throws as of_trial.
  virtual std::vector<calibration::Trajectory> without_noise(const TrialSetup& setup) const = 0;
};

}  // namespace astro::simulation::study
