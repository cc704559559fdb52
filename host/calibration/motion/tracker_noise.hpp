#pragma once

#include <span>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"

/// What a tracker's samples tell about its noise before anything else is known.
namespace astro::calibration {

/// White noise from second differences of neighbouring samples, which a motion hardly has: their median, so
/// that jumps do not count. What a robot accelerates by within two samples is taken for noise, too: 2 mm at
/// 10 Hz. Noise that neighbours share (a tracker that smooths) is not seen.
///
/// Samples that are no numbers are passed over. Cost  linear.
class SecondDifferences {
 public:
  /// One stream; call again for more of the same tracker.
  void add(std::span<const BodySample> truth);

  /// Standard deviations; 0 without three neighbours.
  double sigma_xy_m() const;
  double sigma_theta_rad() const;

 private:
  std::vector<double> position_m_, heading_rad_;
};

/// More than half of the samples have headings: then the others are not used, else no heading is.
bool mostly_headings(std::span<const BodySample> truth);

}  // namespace astro::calibration
