#pragma once

#include <vector>

#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/simulation/study/setup.hpp"

/// Where a study's drives come from: the robot that drives.
namespace astro::simulation::study {

/// The runs of a trial in the order of driving, squares before circles, in the form that each kind of method needs.
struct Drives {
  std::vector<calibration::Trajectory> runs;     // whole, for maximum likelihood
  std::vector<calibration::EndPose> end_errors;  // of each square, for UMBmark and its kin
};

/// A robot that drives the squares and circles of a set-up. Both calls are made by several threads at once, and what they
/// return depends on their arguments alone, to the last bit.
class DriveSource {
 public:
  DriveSource() = default;
  DriveSource(const DriveSource&) = delete;
  DriveSource& operator=(const DriveSource&) = delete;
  virtual ~DriveSource() = default;

  /// Throws astro::Error naming what this robot cannot drive in the set-up, and whatever TrialSetup::check
  /// throws.
  virtual void check(const TrialSetup& setup) const = 0;

  /// The drives of one trial. Throws astro::Error if the robot fails to drive them.
  virtual Drives of_trial(const TrialSetup& setup, int trial) const = 0;

  /// Drives without slip, without errors of the ground truth and with equal clocks, for the Cramer-Rao bound.
  /// Throws as of_trial.
  virtual std::vector<calibration::Trajectory> without_noise(const TrialSetup& setup) const = 0;
};

}  // namespace astro::simulation::study
