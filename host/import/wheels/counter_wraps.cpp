#include "host/import/wheels/counter_wraps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"

namespace astro::importing {
namespace {

using Wheel = double WheelSample::*;

struct Range {
  double least = 0, size = 0;
  std::string_view name;
};

constexpr double kTwo16 = 65'536, kTwo32 = 4'294'967'296, kTurn = 2 * std::numbers::pi;
constexpr double kRounding = 1e-3;  // of an angle that was written with few digits

constexpr Range kCountRanges[] = {{0, kTwo16, "16 bits"},
                                  {-kTwo16 / 2, kTwo16, "16 bits"},
                                  {0, kTwo32, "32 bits"},
                                  {-kTwo32 / 2, kTwo32, "32 bits"}};
constexpr Range kAngleRanges[] = {{-kRounding, kTurn, "one turn"},
                                  {-kTurn / 2 - kRounding, kTurn, "one turn"}};

bool wraps(const std::vector<WheelSample>& samples, Wheel wheel, const Range& range) {
  bool jumps = false;
  const double most = range.least + range.size + (range.size == kTurn ? 2 * kRounding : -1);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double value = samples[i].*wheel;
    if (!(value >= range.least && value <= most)) return false;
    jumps = jumps || (i > 0 && std::abs(value - samples[i - 1].*wheel) > range.size / 2);
  }
  return jumps;
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
    track.remarks.push_back({"the " + side + " wheel starts again at the end of " + std::string(range.name) +
                             "; it was made continuous"});
}

}  // namespace

void unwrap(WheelTrack& track, const std::string& name) {
  if (track.samples.empty() || track.unit == WheelUnit::metres) return;
  const std::span<const Range> ranges = track.unit == WheelUnit::counts
                                            ? std::span<const Range>(kCountRanges)
                                            : std::span<const Range>(kAngleRanges);
  for (const auto& [wheel, side] : {std::pair<Wheel, std::string_view>{&WheelSample::left, "left"},
                                    std::pair<Wheel, std::string_view>{&WheelSample::right, "right"}}) {
    const auto range =
        std::ranges::find_if(ranges, [&, at = wheel](const Range& r) { return wraps(track.samples, at, r); });
    if (range != ranges.end()) unwrap_wheel(track, wheel, *range, name, std::string(side));
  }
}

}  // namespace astro::importing
