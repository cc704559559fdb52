#pragma once

#include <cstddef>
#include <span>

#include "host/calibration/motion/trajectory.hpp"

/// Wheel travel between the samples of the encoders.
namespace astro::calibration {

/// Travel of both wheels of a nominal robot and its rate at a moment.
struct WheelState {
  double left_m = 0, right_m = 0;
  double left_mps = 0, right_mps = 0;
};

/// A cubic through the samples with a continuous rate (Catmull-Rom): at 20 Hz a straight line between them
/// would miss 0.2 mm of an acceleration of 0.5 m/s^2, and its rate would jump, which disturbs the search for
/// the clock offset.
///
/// Times   must not decrease in the samples; before the first and after the last one the wheels stand still.
/// Cost    constant for neighbouring times, logarithmic for others.
class WheelPath {
 public:
  /// At least two samples, which must outlive this.
  explicit WheelPath(std::span<const WheelSample> samples) : samples_(samples) {}

  WheelState at(double time_s) const;

 private:
  std::size_t interval_of(double time_s) const;

  std::span<const WheelSample> samples_;
  mutable std::size_t last_ = 0;  // interval of the last call; the next call is usually close to it
};

}  // namespace astro::calibration
