#pragma once

#include <span>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"

/// An estimate of a tracker's noise from its samples alone.
namespace astro::calibration {

/// White noise from second differences of neighbouring samples, to which a motion contributes little. Their
/// median is used, so that jumps do not count. Acceleration within two samples counts as noise as well: 2 mm at
/// 10 Hz. Noise that neighbours share (from a tracker that smooths) is not detected.
///
/// Samples that are not finite are skipped. Cost  linear.
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

/// Whether more than half of the samples have headings. If so, only those samples are used, otherwise no heading.
bool mostly_headings(std::span<const BodySample> truth);

}  // namespace astro::calibration
