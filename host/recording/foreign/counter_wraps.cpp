#include "host/recording/foreign/counter_wraps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace astro::recording {
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

void unwrap_wheel(WheelTrack& track, Wheel wheel, const Range& range, std::string_view side) {
  double before = track.samples.front().*wheel;
  double turns = 0;
  for (WheelSample& sample : track.samples) {
    const double value = sample.*wheel;
    turns -= std::round((value - before) / range.size);
    before = value;
    sample.*wheel = value + turns * range.size;
  }
  track.remarks.push_back({"the " + std::string(side) + " wheel starts again at the end of " +
                           std::string(range.name) + "; it was made continuous"});
}

}  // namespace

void unwrap(WheelTrack& track) {
  if (track.samples.empty() || track.unit == WheelUnit::metres) return;
  const std::span<const Range> ranges = track.unit == WheelUnit::counts
                                            ? std::span<const Range>(kCountRanges)
                                            : std::span<const Range>(kAngleRanges);
  for (const auto& [wheel, side] : {std::pair<Wheel, std::string_view>{&WheelSample::left, "left"},
                                    std::pair<Wheel, std::string_view>{&WheelSample::right, "right"}}) {
    const auto range =
        std::ranges::find_if(ranges, [&, at = wheel](const Range& r) { return wraps(track.samples, at, r); });
    if (range != ranges.end()) unwrap_wheel(track, wheel, *range, side);
  }
}

}  // namespace astro::recording
