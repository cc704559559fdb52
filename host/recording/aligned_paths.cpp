#include "host/recording/aligned_paths.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "host/recording/rest.hpp"

namespace astro::recording {
namespace {

struct Timed {
  std::int64_t time_us = 0;
  Pose2 pose;
};
using Track = std::vector<Timed>;

template <class Sample>
Timed timed(const Sample& sample) {
  return {sample.time_us, pose_of(sample)};
}

bool before(const Timed& a, const Timed& b) { return a.time_us < b.time_us; }

Track odometry_track(const Run& run) {
  Track track;
  for (const OdometrySample& sample : run.odometry) track.push_back(timed(sample));
  return track;
}

/// Sorted by time, because times that were mapped from another clock may step back.
Track truth_track(const Run& run) {
  Track track;
  for (const TruthSample& sample : run.truth) {
    if (sample.valid && std::isfinite(sample.x_m) && std::isfinite(sample.y_m))
      track.push_back(timed(sample));
  }
  std::stable_sort(track.begin(), track.end(), before);
  return track;
}

Pose2 interpolated(const Pose2& a, const Pose2& b, double share) {
  return {std::lerp(a.x_m, b.x_m, share), std::lerp(a.y_m, b.y_m, share),
          a.theta_rad + share * wrapped_rad(b.theta_rad - a.theta_rad)};
}

std::optional<Pose2> pose_at(const Track& track, std::int64_t time_us, std::int64_t longest_gap_us) {
  const auto after = std::lower_bound(track.begin(), track.end(), Timed{time_us, {}}, before);
  if (after == track.end()) return std::nullopt;
  if (after->time_us == time_us) return after->pose;
  if (after == track.begin()) return std::nullopt;
  const Timed& a = *std::prev(after);
  const std::int64_t gap_us = after->time_us - a.time_us;
  if (gap_us > longest_gap_us) return std::nullopt;
  return interpolated(a.pose, after->pose,
                      static_cast<double>(time_us - a.time_us) / static_cast<double>(gap_us));
}

/// The same moment in both frames; `truth` is empty if there is none.
struct Anchor {
  Pose2 odometry;
  std::optional<Pose2> truth;
};

Anchor find_anchor(const Run& run, const Track& odometry, const Track& truth) {
  if (const auto rest = rest_at_start(run); rest && rest->truth && std::isfinite(rest->truth->theta_rad)) {
    return {rest->odometry, rest->truth};
  }
  for (const Timed& sample : truth) {
    const auto pose = pose_at(odometry, sample.time_us, std::numeric_limits<std::int64_t>::max());
    if (pose && std::isfinite(sample.pose.theta_rad)) return {*pose, sample.pose};
  }
  return {odometry.front().pose, std::nullopt};
}

std::vector<PathPoint> seen_from(const Pose2& frame, const Track& track, std::int64_t zero_us) {
  std::vector<PathPoint> points;
  for (const Timed& sample : track) {
    points.push_back({1e-6 * static_cast<double>(sample.time_us - zero_us), frame.between(sample.pose)});
  }
  return points;
}

}  // namespace

AlignedPaths align_paths(const Run& run) {
  AlignedPaths paths;
  if (run.odometry.empty()) return paths;
  const Track odometry = odometry_track(run);
  const Track truth = truth_track(run);
  const Anchor anchor = find_anchor(run, odometry, truth);
  const std::int64_t zero_us = odometry.front().time_us;
  paths.odometry = seen_from(anchor.odometry, odometry, zero_us);
  if (!anchor.truth) return paths;
  paths.truth = seen_from(*anchor.truth, truth, zero_us);
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    const auto pose = pose_at(truth, odometry[i].time_us, kLongestTruthGapUs);
    if (!pose) continue;
    paths.error.push_back(
        {paths.odometry[i].time_s, difference(anchor.truth->between(*pose), paths.odometry[i].pose)});
  }
  return paths;
}

}  // namespace astro::recording
