#include "host/import/wheels/counter_size.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/base/order_statistics.hpp"

namespace astro::importing {
namespace {

/// The bounds by the sizes of jumps across the end, each of which has an error of the wheel's acceleration. Nothing if the
/// sizes differ too much, or if the values do not fit into such a range.
std::optional<CounterSize> size_by(const WheelSteps& steps, std::vector<double> sizes,
                                   double most_tolerance) {
  constexpr double kCounts = 1.5;  // by which rounding moves a size
  const double size = median_of(sizes), span = steps.highest - steps.lowest;
  for (double& one : sizes) one -= size;
  const double tolerance = kCounts + 3 * deviation_of(sizes) / std::sqrt(static_cast<double>(sizes.size()));
  if (size + tolerance < span + 1 || tolerance > most_tolerance + kCounts) return std::nullopt;
  return CounterSize{steps.lowest, std::max(size - tolerance, span + 1), size + tolerance, sizes.size()};
}

/// The bounds if the wheel jumps back by nearly the same each time, from the end of its range to the beginning or the other way,
/// and goes on as before. Nothing if it does not.
std::optional<CounterSize> range_of_rare_jumps(const WheelSteps& steps) {
  constexpr double kLongerThanSteps = 8;
  const double half = steps.half();
  const std::vector<double>& all = steps.all;
  double longest = 0;
  for (const double step : all)
    if (std::abs(step) <= half) longest = std::max(longest, std::abs(step));
  if (!(half > kLongerThanSteps * longest) || longest == 0) return std::nullopt;
  std::vector<double> sizes;
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    if (std::abs(all[i]) <= half) continue;
    // Across the end the wheel moved as in the steps before and after.
    const double moved = (all[i - 1] + all[i + 1]) / 2;
    // A single wrong count jumps away and back; a counter at its end jumps against the motion.
    if (std::abs(all[i - 1]) > half || std::abs(all[i + 1]) > half || moved * all[i] > 0) return std::nullopt;
    sizes.push_back(all[i] < 0 ? moved - all[i] : all[i] - moved);
  }
  if (sizes.empty()) return std::nullopt;
  return size_by(steps, std::move(sizes), longest);
}

/// The bounds if the wheel comes to the end of its range every few samples: its step changes by the size of the range then, and
/// hardly otherwise.
std::optional<CounterSize> range_of_frequent_jumps(const WheelSteps& steps) {
  constexpr std::size_t kFewestJumps = 4;
  constexpr double kMostDifferent = 0.02, kHardly = 0.25, kOnce = 1.5;  // of the range
  std::vector<double> sizes;
  double most = 0;
  for (std::size_t i = 1; i < steps.all.size(); ++i) {
    const double change = std::abs(steps.all[i] - steps.all[i - 1]);
    if (change > steps.half())
      sizes.push_back(change);
    else
      most = std::max(most, change);
  }
  if (sizes.size() < kFewestJumps) return std::nullopt;
  const double size = median_of(sizes);
  // A single wrong count changes the step by the whole jump, then by twice as much.
  if (most > kHardly * size || std::ranges::max(sizes) > kOnce * size) return std::nullopt;
  return size_by(steps, std::move(sizes), kMostDifferent * size);
}

}  // namespace

WheelSteps::WheelSteps(std::span<const WheelSample> samples, Wheel wheel) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    lowest = std::min(lowest, samples[i].*wheel);
    highest = std::max(highest, samples[i].*wheel);
    if (i > 0) all.push_back(samples[i].*wheel - samples[i - 1].*wheel);
  }
}

std::optional<CounterSize> size_shown(std::span<const WheelSample> samples, Wheel wheel) {
  if (samples.size() < kFewestForSize) return std::nullopt;
  const WheelSteps steps(samples, wheel);
  if (const auto rare = range_of_rare_jumps(steps)) return rare;
  return range_of_frequent_jumps(steps);
}

std::optional<double> roundest(const CounterSize& bounds) {
  constexpr double kByChance = 0.05, kMostDegrees = 3'600;
  for (const double unit : {10'000.0, 5'000.0, 3'600.0, 1'000.0, 500.0, 360.0, 100.0}) {
    const double first = std::ceil(bounds.size_from / unit) * unit;
    if (first > bounds.size_to || (unit == 360 && first > kMostDegrees)) continue;
    if (bounds.size_to - bounds.size_from > kByChance * unit) return std::nullopt;
    return first;
  }
  return std::nullopt;
}

}  // namespace astro::importing
