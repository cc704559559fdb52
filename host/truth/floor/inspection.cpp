#include "host/truth/floor/inspection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "host/base/order_statistics.hpp"
#include "host/truth/files/rotations.hpp"
#include "host/truth/files/tracker_file.hpp"

namespace astro::truth {
namespace {

constexpr std::int64_t kWindow_ns = 500'000'000;  // more of a slow tracker
constexpr double kLongestWindow_ns = 86'400e9;    // samples even further apart show no rest
constexpr std::size_t kFewestSamples = 8;

/// x, y, z, and the rotation relative to the window's first sample as a vector.
using Coordinates = std::array<double, 6>;

Coordinates coordinates_of(const Pose3& pose, const Pose3& first) {
  Quaternion q = rotation_of(pose) * conjugate(rotation_of(first));
  const double sign = q.w < 0 ? -2 : 2;  // small angles: the vector part is half of the angle
  return {pose.x_m, pose.y_m, pose.z_m, sign * q.x, sign * q.y, sign * q.z};
}

/// Statistics of a window. The variance is about the mean of each half.
struct Window {
  std::size_t count = 0;
  Coordinates variance{};
  double moved = 0;  // the largest difference between the means of the halves, in its standard errors
  double moved_m = 0, moved_rad = 0;
};

Window summary_of(const std::vector<TrackedPose>& samples, std::size_t begin, std::size_t end) {
  Window out;
  out.count = end - begin;
  const std::size_t half = out.count / 2;
  std::array<Coordinates, 2> means{};
  const Pose3& first = samples[begin].pose;
  for (std::size_t i = begin; i < end; ++i) {
    const Coordinates c = coordinates_of(samples[i].pose, first);
    const bool late = i - begin >= half;
    for (std::size_t k = 0; k < c.size(); ++k)
      means[late][k] += c[k] / static_cast<double>(late ? out.count - half : half);
  }
  const double n = static_cast<double>(out.count);
  for (std::size_t i = begin; i < end; ++i) {
    const Coordinates c = coordinates_of(samples[i].pose, first);
    const bool late = i - begin >= half;
    for (std::size_t k = 0; k < c.size(); ++k)
      out.variance[k] += std::pow(c[k] - means[late][k], 2) / (n - 2);
  }
  for (std::size_t k = 0; k < 6; ++k) {
    const double step = std::abs(means[1][k] - means[0][k]);
    if (step > 0) out.moved = std::max(out.moved, step / std::sqrt(4 * out.variance[k] / n + 1e-18));
    double& most = k < 3 ? out.moved_m : out.moved_rad;
    most = std::max(most, step);
  }
  return out;
}

std::vector<Window> windows_of(const std::vector<TrackedPose>& samples, std::int64_t window_ns) {
  std::vector<Window> out;
  for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = std::max(end, begin + 1)) {
    end = begin;
    while (end < samples.size() && samples[end].valid &&
           samples[end].time_ns - samples[begin].time_ns < window_ns)
      ++end;
    const bool whole =
        end < samples.size() && samples[end].time_ns - samples[begin].time_ns < window_ns * 3 / 2;
    if (whole && samples[end].valid && end - begin >= kFewestSamples)
      out.push_back(summary_of(samples, begin, end));
  }
  return out;
}

double spread_of(const Window& window) {
  return window.variance[0] + window.variance[1] + window.variance[2];
}

/// The windows in which the body moves no more than its noise explains, as far as a window shows it by itself. Behind a short
/// stand some begin or end in motion, so those count whose variance is like that of the quietest quarter.
std::vector<Window> still_ones(std::vector<Window> windows) {
  constexpr double kMoved = 6, kSpread = 4;           // standard errors; ratio of variances
  constexpr double kSlow_m = 5e-4, kSlow_rad = 2e-3;  // in half a window: 2 mm/s and 8 mrad/s
  constexpr double kCertain = 10;                     // times as much is a motion, however large the noise
  std::erase_if(windows, [](const Window& window) {
    const double motion = std::max(window.moved_m / kSlow_m, window.moved_rad / kSlow_rad);
    return motion > kCertain || (window.moved > kMoved && motion > 1);
  });
  if (windows.empty()) return windows;
  std::vector<double> spreads;
  for (const Window& window : windows) spreads.push_back(spread_of(window));
  const double still = at_rank(std::move(spreads), windows.size() / 4);
  std::erase_if(windows, [&](const Window& window) { return spread_of(window) > kSpread * still + 1e-18; });
  return windows;
}

/// The standard deviations in windows of half a second in which the body moves no more than its noise
/// explains. They are about the mean of each half of a window, so that a slow drift of the tracker does not
/// count. Nothing if all rests together are shorter than a second.
///
/// A stretch in which the tracker repeats the same numbers (invalid samples) is no rest.
std::optional<RestNoise> find_rest_noise(const BodyTrack& track, double period_s) {
  const auto window_ns = std::max(
      kWindow_ns, static_cast<std::int64_t>(std::min(1e9 * kFewestSamples * period_s, kLongestWindow_ns)));
  const std::vector<Window> still = still_ones(windows_of(track.samples, window_ns));
  RestNoise out;
  out.rest_s = 1e-9 * static_cast<double>(window_ns) * static_cast<double>(still.size());
  if (out.rest_s < 1) return std::nullopt;
  // The median, because the last of a few windows may hold the first millimetre of a motion.
  const auto sd = [&](std::size_t k) {
    std::vector<double> variances;
    for (const Window& window : still) variances.push_back(window.variance[k]);
    return std::sqrt(lower_median_of(std::move(variances)));
  };
  for (std::size_t k = 0; k < 3; ++k) out.sd_m[k] = sd(k);
  if (track.facts.rotation_kind != RotationKind::none) out.sd_rad = std::max({sd(3), sd(4), sd(5)});
  return out;
}

double median_period(const std::vector<TrackedPose>& samples) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < samples.size(); ++i)
    steps.push_back(samples[i].time_ns - samples[i - 1].time_ns);
  if (steps.empty()) return 0;
  return 1e-9 * static_cast<double>(median_of(std::move(steps)));
}

void count_gaps(const std::vector<TrackedPose>& samples, BodyInspection& out) {
  const TrackedPose* before = nullptr;  // the last valid sample
  bool within = false;
  for (const TrackedPose& sample : samples) {
    const double since_s = before ? 1e-9 * static_cast<double>(sample.time_ns - before->time_ns) : 0;
    const bool skipped = sample.valid && before && !within && since_s > 1.5 * out.median_period_s;
    if ((!sample.valid && !within) || skipped) ++out.gaps;
    if (sample.valid && (within || skipped)) out.longest_gap_s = std::max(out.longest_gap_s, since_s);
    within = !sample.valid;
    if (sample.valid) before = &sample;
  }
}

}  // namespace

BodyInspection inspect(BodyTrack& track) {
  BodyInspection out;
  out.name = {track.name, track.id};
  out.facts = track.facts;
  out.samples = track.samples.size();
  out.lost = mark_lost(track);
  if (!track.samples.empty())
    out.duration_s = 1e-9 * static_cast<double>(track.samples.back().time_ns - track.samples.front().time_ns);
  out.median_period_s = median_period(track.samples);
  count_gaps(track.samples, out);
  out.up = find_up_axis(track);
  out.noise = find_rest_noise(track, out.median_period_s);
  return out;
}

Inspection inspect(std::string_view text, std::string_view file, std::string_view columns) {
  constexpr std::size_t kMostBodies = 50;
  const std::vector<BodyName> bodies = bodies_in(text, file, columns);
  Inspection out;
  out.kind = columns.empty() ? recognise(text) : FileKind::plain;
  out.bodies_left_out = bodies.size() - std::min(bodies.size(), kMostBodies);
  for (std::size_t i = 0; i < bodies.size() - out.bodies_left_out; ++i) {
    BodyTrack track = read_track(text, file, bodies[i].id.empty() ? bodies[i].name : bodies[i].id, columns);
    out.bodies.push_back(inspect(track));
  }
  return out;
}

}  // namespace astro::truth
