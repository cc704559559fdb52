#pragma once

#include <algorithm>
#include <vector>

namespace astro::calibration {

/// Of samples with a `time_s`, at least two: the median of the times between neighbours, s.
template <class Sample>
double median_period_s(const std::vector<Sample>& samples) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < samples.size(); ++i)
    periods.push_back(samples[i].time_s - samples[i - 1].time_s);
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

}  // namespace astro::calibration
