#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace astro {

/// The value that stands at `rank`, from 0, once the values are sorted. Precondition: rank < values.size().
template <class Value>
Value at_rank(std::vector<Value> values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The median; of an even count the upper of the two in the middle. Precondition: at least one value.
template <class Value>
Value median_of(std::vector<Value> values) {
  const std::size_t rank = values.size() / 2;
  return at_rank(std::move(values), rank);
}

/// The same, but of an even count the lower one, so that half of the values cannot make the other half look usual.
template <class Value>
Value lower_median_of(std::vector<Value> values) {
  const std::size_t rank = (values.size() - 1) / 2;
  return at_rank(std::move(values), rank);
}

/// Standard deviation of normal errors about 0 from the median of their magnitudes, so that a few outliers do not
/// matter. Precondition: at least one error.
inline double deviation_of(std::vector<double> errors) {
  constexpr double kMedianOfNormal = 0.6745;
  for (double& error : errors) error = std::abs(error);
  return median_of(std::move(errors)) / kMedianOfNormal;
}

/// Median time between neighbouring samples, in s. Precondition: at least two samples with a `time_s`.
template <class Samples>
double median_period_s(const Samples& samples) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < samples.size(); ++i)
    periods.push_back(samples[i].time_s - samples[i - 1].time_s);
  return median_of(std::move(periods));
}

}  // namespace astro
