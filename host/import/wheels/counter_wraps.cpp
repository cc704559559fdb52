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
#include "host/import/wheels/counter_size.hpp"
#include "host/import/wheels/restarts.hpp"

namespace astro::importing {
namespace {

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
  for (const int bits : {8, 10, 12, 14, 16, 24, 32}) {
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

[[noreturn]] void refuse_jump(const WheelSample& from, const WheelSample& to, Wheel wheel,
                              const std::string& name, const std::string& side) {
  const std::string before = to_text(from.*wheel), after = to_text(to.*wheel),
                    time = seconds_text(to.time_ns / 1000);
  throw Error(name + ": the " + side + " wheel jumps from " + before + " to " + after + " at " + time +
                  " s, which is neither motion nor the end of a counter whose range is known",
              CounterProblem::starts_again, {name, side, before, after, time});
}

/// How often the wheel passed the end of the range between two samples; forwards is positive. `name` and
/// `side` are for error messages.
double passes_between(const WheelSample& from, const WheelSample& to, Wheel wheel, const Range& range,
                      const Pace& pace, const std::string& name, const std::string& side) {
  const double jump = to.*wheel - from.*wheel, time_s = Pace::seconds(from, to);
  const double passes = -std::round(jump / range.size);
  if (passes == 0 || pace.fits(std::abs(jump + passes * range.size), time_s)) return passes;
  if (pace.fits(std::abs(jump), time_s)) return 0;
  refuse_jump(from, to, wheel, name, side);
}

/// A longer period than this is one in which samples were lost.
double late_period_ns(const std::vector<WheelSample>& samples) {
  constexpr double kLate = 2.5;  // of the usual period
  std::vector<std::int64_t> periods;
  for (std::size_t i = 1; i < samples.size(); ++i)
    periods.push_back(samples[i].time_ns - samples[i - 1].time_ns);
  return kLate * static_cast<double>(median_of(std::move(periods)));
}

/// Refuses a wheel that moves nearly half its range from one sample to the next, because then its direction is not known.
void refuse_fast(const std::vector<WheelSample>& samples, Wheel wheel, const Range& range,
                 const std::string& name, const std::string& side) {
  constexpr double kNearlyHalf = 0.45;
  if (samples.size() < kFewestForSize) return;
  const double late_ns = late_period_ns(samples);
  double step = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double before = std::exchange(step, samples[i].*wheel - samples[i - 1].*wheel);
    if (static_cast<double>(samples[i].time_ns - samples[i - 1].time_ns) > late_ns) continue;
    const bool turns = i > 1 && std::abs(step - before) > range.size / 2;
    if (std::abs(step) <= kNearlyHalf * range.size && !turns) continue;
    throw Error(name + ": from one sample to the next the " + side + " wheel moves by half of the " +
                    range.name + " of its counter or more, so that its direction is not known",
                CounterProblem::too_fast, {name, side, range.name});
  }
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
  if (!any) return;
  if (track.unit == WheelUnit::counts) {
    refuse_fast(track.samples, wheel, range, name, side);
    track.counter_range = range.size;
  }
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

[[noreturn]] void refuse_range(const CounterSize& bounds, const std::string& name, const std::string& side) {
  const std::string from = to_text(std::ceil(bounds.size_from)), to = to_text(std::floor(bounds.size_to));
  throw Error(
      name + ": the counter of the " + side + " wheel starts again after " + from + " to " + to + " counts",
      CounterProblem::range_unknown, {name, side, from, to});
}

/// The range in which a wheel wraps; nothing if it does not.
std::optional<Range> range_of(const WheelTrack& track, Wheel wheel, const std::string& name,
                              const std::string& side) {
  std::optional<CounterSize> bounds;
  if (track.unit == WheelUnit::counts) bounds = size_shown(track.samples, wheel);
  for (const Range& range : usual_ranges(track.unit))
    if ((!range.to_both_ends ||
         (bounds ? bounds->hold(range.size) : track.samples.size() < kFewestForSize)) &&
        wraps(track.samples, wheel, range))
      return range;
  if (!bounds) return std::nullopt;
  const auto size = roundest(*bounds);
  if (!size || bounds->least < 0) refuse_range(*bounds, name, side);
  return Range{0, *size, to_text(*size) + " counts"};
}

/// Refuses a jump that is no motion and that the next sample does not undo, of a wheel for which no range was found.
void refuse_jumps(const std::vector<WheelSample>& samples, Wheel wheel, const std::string& name,
                  const std::string& side) {
  constexpr double kFewCounts = 50;  // coarse encoders go no further in a short drive
  constexpr double kUndone = 0.5;    // of a jump
  const WheelSteps steps(samples, wheel);
  const double half = steps.half(), late_ns = late_period_ns(samples);
  if (samples.size() < kFewestForSize || half < kFewCounts) return;
  for (std::size_t i = 1; i + 1 < steps.all.size(); ++i) {
    const double step = steps.all[i], change = step - steps.all[i - 1];
    const auto undoes = [&](double one, double other) {
      return std::abs(one + other) < kUndone * std::abs(one);
    };
    if (std::abs(step) <= half || std::abs(change) <= half || undoes(step, steps.all[i + 1]) ||
        undoes(step, steps.all[i - 1]) ||
        static_cast<double>(samples[i + 1].time_ns - samples[i].time_ns) > late_ns)
      continue;
    refuse_jump(samples[i], samples[i + 1], wheel, name, side);
  }
}

/// Whether both wheels come to the end of the same range again and again, which a controller that was reset does not.
bool wrap_alike(const std::vector<WheelSample>& samples) {
  const auto left = size_shown(samples, &WheelSample::left), right = size_shown(samples, &WheelSample::right);
  return left && right && left->jumps > 1 && right->jumps > 1 && left->size_from <= right->size_to &&
         right->size_from <= left->size_to;
}

}  // namespace

void unwrap(WheelTrack& track, const std::string& name, std::optional<double> stated) {
  if (track.samples.empty()) return;
  if (!stated && !(track.unit == WheelUnit::counts && wrap_alike(track.samples))) join_restarts(track, name);
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
    else if (track.unit == WheelUnit::counts)
      refuse_jumps(track.samples, wheels[i].first, name, wheels[i].second);
  }
}

}  // namespace astro::importing
