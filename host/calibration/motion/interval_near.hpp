#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace astro::calibration {

/// The interval i between samples that holds a moment, time_of(samples[i]) <= time_s < time_of(samples[i + 1]); the first one before all
/// of them and the last one behind. `last`: where the search of before ended, and now this one; moments are mostly asked for in
/// order, and then nothing has to be searched.
///
/// Precondition: two samples at least, whose times do not decrease. Cost  constant next to `last`, logarithmic elsewhere.
template <class Sample, class TimeOf>
std::size_t interval_near(std::size_t& last, std::span<const Sample> samples, double time_s, TimeOf time_of) {
  constexpr std::size_t kNear = 8;
  for (std::size_t i = last; i < last + kNear && i + 1 < samples.size(); ++i)
    if (time_of(samples[i]) <= time_s && time_s < time_of(samples[i + 1])) return last = i;
  const auto next =
      std::upper_bound(samples.begin() + 1, samples.end() - 1, time_s,
                       [&](double time, const Sample& sample) { return time < time_of(sample); });
  return last = static_cast<std::size_t>(next - samples.begin()) - 1;
}

}  // namespace astro::calibration
