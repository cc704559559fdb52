#pragma once

#include <cstddef>
#include <vector>

#include "host/recording/run/planar_pose.hpp"
#include "host/recording/run/run.hpp"

/// A run for the figures: odometry and its error at the same times.
namespace astro::report {

/// In the run's start frame, time from its first odometry sample. `error` is truth - odometry, NaN where the
/// tracker had lost the robot.
struct SeriesPoint {
  double time_s = 0;
  recording::PlanarPose odometry, error;
};

/// recording::align_paths at the times of odometry: if the tracker is silent, the figure has a gap.
std::vector<SeriesPoint> series_of(const recording::Run& run);

/// At most `most` points (two or more), evenly spaced by index, the first and the last among them.
std::vector<SeriesPoint> thin(std::vector<SeriesPoint> points, std::size_t most);

}  // namespace astro::report
