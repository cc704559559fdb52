#pragma once

#include <Eigen/Core>
#include <vector>

#include "host/calibration/motion/motion_profile.hpp"

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

  /// Cost  2 ns for each bin in which the two overlap.
  Agreement at(const ClockGuess& guess) const;

 private:
  struct Sums;
  struct Alignment;
  Sums sums(const ClockGuess& guess) const;
  void add_row(const Alignment& alignment, double from, double to, Sums& sums) const;

  struct Whole {  // of all known bins: their number, means, and sum of squares about the means
    double count = 0, mean_mps[2] = {}, square = 0;
    /// Sum of squares of the rates themselves.
    double motion() const { return square + count * (mean_mps[0] * mean_mps[0] + mean_mps[1] * mean_mps[1]); }
  };
  static Whole centred(MotionProfile& profile);

  /// A profile's speeds and turn rates once more, in rows that are added up several bins at a time.
  struct Rows {
    explicit Rows(const MotionProfile& profile);
    Eigen::ArrayXd speed, turn;
    Eigen::ArrayXd speed_step, turn_step;  // to the next bin
  };

  /// Neighbouring bins of truth that are all known: begin..end-1.
  struct Stretch {
    std::size_t begin, end;
  };

  MotionProfile wheels_, truth_;
  double noise_;  // variance
  Whole all_wheels_, all_truth_;
  Rows wheel_rows_, truth_rows_;
  Eigen::ArrayXd index_;  // 0, 1, 2 ..
  /// Before each bin of the wheels: sums of speeds, of turn rates, and of the squares of both.
  std::vector<Eigen::Array3d> wheels_before_;
  std::vector<Stretch> stretches_;
};

}  // namespace astro::calibration
