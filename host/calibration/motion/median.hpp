#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace astro::calibration {

/// The median; of an even count the upper of the two in the middle. Precondition: at least one number.
inline double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Standard deviation of normal errors about 0 from the median of their magnitudes, so that a few outliers do not
/// matter. Precondition: at least one error.
inline double deviation_of(std::vector<double> errors) {
  constexpr double kMedianOfNormal = 0.6745;
  for (double& error : errors) error = std::abs(error);
  return median_of(std::move(errors)) / kMedianOfNormal;
}

}  // namespace astro::calibration
