#pragma once

#include <utility>
#include <vector>

#include "host/calibration/motion/median.hpp"

namespace astro::calibration {

/// Median time between neighbouring samples, in s. Precondition: at least two samples with a `time_s`.
template <class Sample>
double median_period_s(const std::vector<Sample>& samples) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < samples.size(); ++i)
    periods.push_back(samples[i].time_s - samples[i - 1].time_s);
  return median_of(std::move(periods));
}

}  // namespace astro::calibration
