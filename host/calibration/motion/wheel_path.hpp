#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "host/calibration/motion/trajectory.hpp"

/// Wheel travel between the samples of the encoders, and the search for the interval between samples that holds a moment.
namespace astro::calibration {

/// The index i of the interval between samples that contains `time_s`, time_of(samples[i]) <= time_s < time_of(samples[i + 1]).
/// It is the first interval for times before all samples, and the last one for times after. `last`: the result of the previous
/// search; it is updated. Calls mostly come in order of time, and then no search is needed.
///
/// Precondition: two samples at least, whose times do not decrease. Cost  constant next to `last`, logarithmic elsewhere.
template <class Sample, class TimeOf>
std::size_t interval_near(std::size_t& last, std::span<const Sample> samples, double time_s, TimeOf time_of) {
  constexpr std::size_t kTriedInOrder = 8;
  for (std::size_t i = last; i < last + kTriedInOrder && i + 1 < samples.size(); ++i)
    if (time_of(samples[i]) <= time_s && time_s < time_of(samples[i + 1])) return last = i;
  const auto next =
      std::upper_bound(samples.begin() + 1, samples.end() - 1, time_s,
                       [&](double time, const Sample& sample) { return time < time_of(sample); });
  return last = static_cast<std::size_t>(next - samples.begin()) - 1;
}

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
