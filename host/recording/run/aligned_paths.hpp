#pragma once

#include <vector>

#include "host/recording/run/planar_pose.hpp"
#include "host/recording/run/run.hpp"

namespace astro::recording {

struct PathPoint {
  double time_s = 0;  // since the first odometry sample
  PlanarPose pose;
};

/// The two paths of a run laid over one another for plots: both in the run's start frame (x forward, y left),
/// and what truth has over odometry at the times of odometry.
struct AlignedPaths {
  std::vector<PathPoint> odometry;
  std::vector<PathPoint> truth;  // valid samples only
  std::vector<PathPoint> error;  // truth - odometry; theta in [-pi, pi]
};

/// Truth is interpolated between samples no further apart than this; where it is lost for longer there is no
/// error.
inline constexpr std::int64_t kLongestTruthGapUs = 250'000;

/// The start is the standstill at the beginning (rest.hpp), or for runs that begin in motion the first valid
/// truth sample with a heading. Without truth the odometry path starts at its first pose and the others are
/// empty; an empty run gives empty paths. Never throws.
AlignedPaths align_paths(const Run& run);

}  // namespace astro::recording
