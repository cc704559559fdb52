#pragma once

#include <vector>

#include "host/base/pose2.hpp"
#include "host/recording/run.hpp"

namespace astro::recording {

struct PathPoint {
  double time_s = 0;  // since the first odometry sample
  Pose2 pose;
};

/// The two paths of a run in one frame, for plots: both in the run's start frame (x forward, y left), and the
/// difference of truth and odometry at the times of odometry.
struct AlignedPaths {
  std::vector<PathPoint> odometry;
  std::vector<PathPoint> truth;  // valid samples only
  std::vector<PathPoint> error;  // truth - odometry; theta in [-pi, pi]
};

/// Truth is interpolated between samples that are at most this far apart; in longer gaps no error is
/// computed.
inline constexpr std::int64_t kLongestTruthGapUs = 250'000;

/// The start is the rest at the beginning (rest.hpp), or for runs that begin in motion the first valid truth
/// sample with a heading. Without truth the odometry path starts at its first pose and the others are
/// empty; an empty run gives empty paths. Never throws.
AlignedPaths align_paths(const Run& run);

}  // namespace astro::recording
