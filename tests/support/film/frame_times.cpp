#include "tests/support/film/frame_times.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace astro::support::film {
namespace {

double whole_microseconds(double seconds) { return std::round(seconds * 1e6) / 1e6; }

std::vector<FrameTime> without(const Cut& cut, const std::vector<FrameTime>& frames) {
  std::vector<FrameTime> left;
  for (FrameTime frame : frames) {
    if (frame.pts_s >= cut.from_s && frame.pts_s < cut.to_s) continue;
    if (frame.pts_s >= cut.to_s && cut.closed)
      frame.pts_s = whole_microseconds(frame.pts_s - (cut.to_s - cut.from_s));
    left.push_back(frame);
  }
  return left;
}

}  // namespace

std::vector<FrameTime> frame_times(const FilmClock& clock, double begin_s, double end_s,
                                   const std::optional<Cut>& cut) {
  std::mt19937_64 random(clock.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  // No frame moves by more than a third of the interval, so that they stay in order.
  const double interval_s = (1 + clock.skew) / clock.fps;
  const auto off = [&](double sd_s) {
    return std::clamp(sd_s * normal(random), -interval_s / 3, interval_s / 3);
  };
  std::vector<FrameTime> frames;
  const auto count = static_cast<int>((end_s - begin_s) / interval_s);
  for (int i = 0; i < count; ++i) {
    const double robot_s = begin_s + i * interval_s + (i == 0 ? 0 : off(clock.jitter_s));
    const double stamp_s = (robot_s - begin_s) / (1 + clock.skew) + (i == 0 ? 0 : off(clock.stamp_s));
    if (i == 0 || uniform(random) >= clock.lost) frames.push_back({robot_s, whole_microseconds(stamp_s)});
  }
  return cut ? without(*cut, frames) : frames;
}

}  // namespace astro::support::film
