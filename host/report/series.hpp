#pragma once

#include <cstddef>
#include <vector>

#include "host/recording/run.hpp"

/// A run as the figures need it: what the robot believed beside what happened, at the same times, in one
/// frame.
namespace astro::report {

/// Both poses in the run's start frame (x forward, y left, theta counter-clockwise and continuous), time from
/// the start of the run. The truth is NaN where the tracker had lost the body.
struct PathPoint {
  double time_s = 0;
  double odometry_x_m = 0, odometry_y_m = 0, odometry_theta_rad = 0;
  double truth_x_m = 0, truth_y_m = 0, truth_theta_rad = 0;
};

/// The run at the times of its odometry. The start frame is each stream's own pose at the first odometry
/// sample that has a truth (the first sample of all, if none has). Truth is interpolated linearly between
/// valid samples at most 0.2 s apart: a longer silence of the tracker is shown as a gap, never invented.
std::vector<PathPoint> align(const recording::Run& run);

/// At most `most` points (two or more), evenly spaced by index, the first and the last among them.
std::vector<PathPoint> thin(std::vector<PathPoint> points, std::size_t most);

}  // namespace astro::report
