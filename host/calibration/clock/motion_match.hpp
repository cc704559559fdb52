#pragma once

#include "host/calibration/clock/motion_profile.hpp"

/// How well the motion of the wheels and that of the truth agree for a given offset of their clocks.
namespace astro::calibration {

/// A robot's time and a tracker's time of the same moment, and by how much faster the robot's clock runs.
struct ClockGuess {
  double robot_s = 0, truth_s = 0, skew = 0;
};

struct Agreement {
  /// Correlation of speeds and turn rates about their means where both are known, corrected for the tracker's
  /// noise, and reduced if neither recording covers the motion of the other; standing still beyond its ends does not count.
  /// At most about 1; -1 without overlap.
  double correlation = -1;
  double likeness = 0;     // of speeds and turn rates themselves: near 1 for a steady motion as well
  double unexplained = 1;  // part of the truth's variance, its noise included
  double overlap_s = 0;
};

/// Compares two profiles with equal bins. Every bin of the wheels must be known.
class MotionMatch {
 public:
  /// `noise_mps`: standard deviation of the noise in the truth's rates. Smaller rates do not count as motion.
  MotionMatch(MotionProfile wheels, MotionProfile truth, double noise_mps);

  /// Cost  5 ns for each bin in which the two overlap.
  Agreement at(const ClockGuess& guess) const;

 private:
  struct Sums;
  Sums sums(const ClockGuess& guess) const;

  struct Whole {  // of all known bins: their number, means, and sum of squares about the means
    double count = 0, mean_mps[2] = {}, square = 0;
    /// Sum of squares of the rates themselves.
    double motion() const { return square + count * (mean_mps[0] * mean_mps[0] + mean_mps[1] * mean_mps[1]); }
  };
  static Whole centred(MotionProfile& profile);

  MotionProfile wheels_, truth_;
  double noise_;  // variance
  Whole all_wheels_, all_truth_;
};

}  // namespace astro::calibration
