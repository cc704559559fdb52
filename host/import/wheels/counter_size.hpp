#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "host/import/wheels/wheel_track.hpp"

/// How many counts a counter has before it starts again, found from its jumps.
namespace astro::importing {

using Wheel = double WheelSample::*;

/// The lowest and the highest value of a wheel, and the steps from sample to sample.
struct WheelSteps {
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  std::vector<double> all;

  WheelSteps(std::span<const WheelSample> samples, Wheel wheel);
  double half() const { return (highest - lowest) / 2; }
};

/// The bounds within which the number of counts is.
struct CounterSize {
  double least = 0, size_from = 0, size_to = 0;
  std::size_t jumps = 0;  // whose sizes agree

  bool hold(double size) const { return size >= size_from && size <= size_to; }
};

/// Fewer samples do not show a size.
inline constexpr std::size_t kFewestForSize = 20;

/// Nothing if the wheel does not jump from one end of a range to the other and go on as before.
std::optional<CounterSize> size_shown(std::span<const WheelSample> samples, Wheel wheel);

/// The roundest whole number within bounds; nothing if the bounds are so wide that such a number may be there by chance.
std::optional<double> roundest(const CounterSize& size);

}  // namespace astro::importing
