#pragma once

#include "host/calibration/clock/motion_profile.hpp"

/// How well the motion of the wheels and that of the truth agree when their clocks are laid over one another.
namespace astro::calibration {

/// A robot's time and a tracker's time that are the same moment, and by how much faster the robot's clock
/// runs.
struct ClockGuess {
  double robot_s = 0, truth_s = 0, skew = 0;
};

struct Agreement {
  /// Of how speeds and turn rates differ from their means where both are known, as it would be without the
  /// tracker's noise; less where neither recording is covered by the other. At most about 1; -1 without
  /// overlap.
  double correlation = -1;
  double likeness = 0;     // of speeds and turn rates themselves: near 1 for a steady motion, too
  double unexplained = 1;  // part of the truth's variance, its noise included
  double overlap_s = 0;
};

/// Two profiles of equal bins. All of the wheels' must be known.
class MotionMatch {
 public:
  /// `noise_mps`: standard deviation of the noise in the truth's rates. What does not rise above it is not
  /// taken for motion.
  MotionMatch(MotionProfile wheels, MotionProfile truth, double noise_mps);

  /// Cost  5 ns for each bin in which the two overlap.
  Agreement at(const ClockGuess& guess) const;

 private:
  struct Sums;
  Sums sums(const ClockGuess& guess) const;

  struct Whole {  // of all known bins: how many, means, and squares about them
    double count = 0, mean_mps[2] = {}, square = 0;
  };
  static Whole centred(MotionProfile& profile);

  MotionProfile wheels_, truth_;
  double noise_;  // variance
  Whole all_wheels_, all_truth_;
};

}  // namespace astro::calibration
