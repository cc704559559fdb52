#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace astro::calibration {

/// Of at least one number; of an even count the upper of the two in the middle.
inline double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Standard deviation of mostly normal errors about 0, whatever a few of them are: from the median of their
/// sizes. Of at least one.
inline double deviation_of(std::vector<double> errors) {
  constexpr double kMedianOfNormal = 0.6745;
  for (double& error : errors) error = std::abs(error);
  return median_of(std::move(errors)) / kMedianOfNormal;
}

}  // namespace astro::calibration
