#include "host/import/wheels/counter_wraps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/order_statistics.hpp"
#include "host/base/text/numbers.hpp"
#include "host/import/wheels/restarts.hpp"

namespace astro::importing {
namespace {

using Wheel = double WheelSample::*;

struct Range {
  double least = 0, size = 0;
  std::string name;
  bool to_both_ends = false;  // a jump counts only if it goes from one end to the other
};

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRounding = 1e-3;  // of an angle that was written with few digits

/// Ranges that are usual, the smallest first.
std::vector<Range> usual_ranges(WheelUnit unit) {
  if (unit == WheelUnit::radians)
    return {{-kRounding, kTurn, "one turn"}, {-kTurn / 2 - kRounding, kTurn, "one turn"}};
  std::vector<Range> ranges;
  for (const int bits : {8, 12, 16, 24, 32}) {
    const double size = std::exp2(bits);
    const bool rare = bits != 16 && bits != 32;
    for (const double least : {0.0, -size / 2})
      ranges.push_back({least, size, std::to_string(bits) + " bits", rare});
  }
  return ranges;
}

/// The largest step of a wheel and its greatest speed between samples, without jumps of more than half the
/// range.
struct Pace {
  double step = 0, speed = 0;

  Pace(const std::vector<WheelSample>& samples, Wheel wheel, const Range& range) {
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const double size = std::abs(samples[i].*wheel - samples[i - 1].*wheel);
      if (size > range.size / 2) continue;
      step = std::max(step, size);
      speed = std::max(speed, size / seconds(samples[i - 1], samples[i]));
    }
  }
  /// Whether a step may be motion: lost messages make a step longer, and delays make its time shorter.
  bool fits(double size, double time_s) const {
    constexpr double kMostTimes = 4;
    return step == 0 || size <= kMostTimes * step || size <= kMostTimes * speed * time_s;
  }
  static double seconds(const WheelSample& from, const WheelSample& to) {
    return 1e-9 * static_cast<double>(to.time_ns - from.time_ns);
  }
};

bool wraps(const std::vector<WheelSample>& samples, Wheel wheel, const Range& range) {
  bool jumps = false;
  const double most = range.least + range.size + (range.size == kTurn ? 2 * kRounding : -1);
  const double near = 2 * Pace(samples, wheel, range).step;
  const auto at_an_end = [&](double value) { return value - range.least <= near || most - value <= near; };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double value = samples[i].*wheel;
    if (!(value >= range.least && value <= most)) return false;
    if (i == 0 || std::abs(value - samples[i - 1].*wheel) <= range.size / 2) continue;
    if (range.to_both_ends && !(at_an_end(value) && at_an_end(samples[i - 1].*wheel))) return false;
    jumps = true;
  }
  return jumps;
}

/// The bounds within which the number of counts of an unusual range is: the wheel jumps back again and again by nearly the
/// same, and goes on as before.
struct Bounds {
  double least = 0, size_from = 0, size_to = 0;
};

/// Nothing if the wheel does not jump so.
std::optional<Bounds> unusual_range(const std::vector<WheelSample>& samples, Wheel wheel) {
  constexpr double kLongerThanSteps = 8, kCounts = 1.5;  // by which rounding moves a size
  constexpr std::size_t kFewestJumps = 2, kFewestSamples = 20;
  if (samples.size() < kFewestSamples) return std::nullopt;
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  std::vector<double> steps;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    lowest = std::min(lowest, samples[i].*wheel);
    highest = std::max(highest, samples[i].*wheel);
    if (i > 0) steps.push_back(samples[i].*wheel - samples[i - 1].*wheel);
  }
  const double half = (highest - lowest) / 2;
  double longest = 0;
  for (const double step : steps)
    if (std::abs(step) <= half) longest = std::max(longest, std::abs(step));
  if (!(half > kLongerThanSteps * longest) || longest == 0) return std::nullopt;
  std::vector<double> sizes;
  for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
    if (std::abs(steps[i]) <= half) continue;
    // Across the end the wheel moved as in the steps before and after.
    const double moved = (steps[i - 1] + steps[i + 1]) / 2;
    // A single wrong count jumps away and back; a counter at its end jumps against the motion.
    if (std::abs(steps[i - 1]) > half || std::abs(steps[i + 1]) > half || moved * steps[i] > 0)
      return std::nullopt;
    sizes.push_back(steps[i] < 0 ? moved - steps[i] : steps[i] - moved);
  }
  if (sizes.size() < kFewestJumps) return std::nullopt;
  const double size = median_of(sizes);
  for (double& one : sizes) one -= size;
  const double tolerance = kCounts + 3 * deviation_of(sizes) / std::sqrt(static_cast<double>(sizes.size()));
  if (size + tolerance < highest - lowest + 1 || tolerance > longest + kCounts) return std::nullopt;
  return Bounds{lowest, std::max(size - tolerance, highest - lowest + 1), size + tolerance};
}

/// The roundest whole number within bounds; nothing if the bounds are so wide that such a number may be there by chance.
std::optional<double> roundest(const Bounds& bounds) {
  constexpr double kByChance = 0.05, kMostDegrees = 3'600;
  for (const double unit : {10'000.0, 5'000.0, 3'600.0, 1'000.0, 500.0, 360.0, 100.0}) {
    const double first = std::ceil(bounds.size_from / unit) * unit;
    if (first > bounds.size_to || (unit == 360 && first > kMostDegrees)) continue;
    if (bounds.size_to - bounds.size_from > kByChance * unit) return std::nullopt;
    return first;
  }
  return std::nullopt;
}

/// How often the wheel passed the end of the range between two samples; forwards is positive. `name` and
/// `side` are for error messages.
double passes_between(const WheelSample& from, const WheelSample& to, Wheel wheel, const Range& range,
                      const Pace& pace, const std::string& name, const std::string& side) {
  const double jump = to.*wheel - from.*wheel, time_s = Pace::seconds(from, to);
  const double passes = -std::round(jump / range.size);
  if (passes == 0 || pace.fits(std::abs(jump + passes * range.size), time_s)) return passes;
  if (pace.fits(std::abs(jump), time_s)) return 0;
  const std::string before = to_text(from.*wheel), after = to_text(to.*wheel),
                    time = seconds_text(to.time_ns / 1000);
  throw Error(name + ": the " + side + " wheel jumps from " + before + " to " + after + " at " + time +
                  " s, which is neither motion nor the end of a counter, as where a counter starts again; "
                  "cut it there",
              CounterProblem::starts_again, {name, side, before, after, time});
}

void unwrap_wheel(WheelTrack& track, Wheel wheel, const Range& range, const std::string& name,
                  const std::string& side) {
  const Pace pace(track.samples, wheel, range);
  WheelSample before = track.samples.front();
  double passes = 0;
  bool any = false;
  for (WheelSample& sample : track.samples) {
    const double more = passes_between(before, sample, wheel, range, pace, name, side);
    any = any || more != 0;
    passes += more;
    before = sample;
    sample.*wheel += passes * range.size;
  }
  if (any)
    track.remarks.push_back(
        {"the " + side + " wheel starts again at the end of " + range.name + "; it was made continuous",
         WheelRemark::continued,
         {side, range.name}});
}

bool holds(const Range& range, const std::vector<WheelSample>& samples, Wheel wheel) {
  return std::all_of(samples.begin(), samples.end(), [&](const WheelSample& sample) {
    return sample.*wheel >= range.least && sample.*wheel < range.least + range.size;
  });
}

/// A range that somebody stated, at the end at which the values are.
Range stated_range(const std::vector<WheelSample>& samples, Wheel wheel, double size, const std::string& name,
                   const std::string& side) {
  double lowest = 0, highest = 0;
  for (const WheelSample& sample : samples) {
    lowest = std::min(lowest, sample.*wheel);
    highest = std::max(highest, sample.*wheel);
  }
  const Range range{lowest < 0 ? -size / 2 : 0, size, to_text(size) + " counts"};
  for (const double value : {lowest, highest})
    if (value < range.least || value >= range.least + size)
      throw Error(name + ": the " + side + " wheel has a count of " + to_text(value) + ", which a range of " +
                      to_text(size) + " counts does not have",
                  CounterProblem::beyond_range, {name, side, to_text(value), to_text(size)});
  return range;
}

/// The range in which a wheel wraps; nothing if it does not.
std::optional<Range> range_of(const WheelTrack& track, Wheel wheel, const std::string& name,
                              const std::string& side) {
  for (const Range& range : usual_ranges(track.unit))
    if (wraps(track.samples, wheel, range)) return range;
  if (track.unit != WheelUnit::counts) return std::nullopt;
  const auto bounds = unusual_range(track.samples, wheel);
  if (!bounds) return std::nullopt;
  const auto size = roundest(*bounds);
  if (!size || bounds->least < 0) {
    const std::string from = to_text(std::ceil(bounds->size_from)), to = to_text(std::floor(bounds->size_to));
    throw Error(name + ": the counter of the " + side + " wheel starts again and again, after " + from +
                    " to " + to + " counts",
                CounterProblem::range_unknown, {name, side, from, to});
  }
  return Range{0, *size, to_text(*size) + " counts"};
}

}  // namespace

void unwrap(WheelTrack& track, const std::string& name, std::optional<double> stated) {
  if (track.samples.empty()) return;
  if (!stated) join_restarts(track, name);
  if (track.unit == WheelUnit::metres) return;
  const std::array<std::pair<Wheel, std::string>, 2> wheels{
      {{&WheelSample::left, "left"}, {&WheelSample::right, "right"}}};
  std::array<std::optional<Range>, 2> ranges;
  for (std::size_t i = 0; i < 2; ++i)
    ranges[i] = stated && track.unit == WheelUnit::counts
                    ? stated_range(track.samples, wheels[i].first, *stated, name, wheels[i].second)
                    : range_of(track, wheels[i].first, name, wheels[i].second);
  for (std::size_t i = 0; i < 2; ++i) {
    // One wheel may wrap too seldom to show its range, which is that of the other.
    const std::optional<Range>& range = ranges[i] ? ranges[i] : ranges[1 - i];
    if (range && (ranges[i] || holds(*range, track.samples, wheels[i].first)))
      unwrap_wheel(track, wheels[i].first, *range, name, wheels[i].second);
  }
}

}  // namespace astro::importing
