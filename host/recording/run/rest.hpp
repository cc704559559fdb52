#pragma once

#include <optional>

#include "host/recording/run/planar_pose.hpp"
#include "host/recording/run/run.hpp"

/// Where a run stands still at its ends. Averages over these stretches are what a run is judged by: a single
/// tracker sample has noise of about its resolution, the mean of n samples a sqrt(n)-th of it.
namespace astro::recording {

/// No wheel has moved by more than this many counts from where it stood: an encoder that rests on an edge
/// flickers.
inline constexpr std::int32_t kStillCounts = 1;
/// A shorter stop is not called standing still: two frames of the slowest tracker (30 Hz) must fit well
/// inside.
inline constexpr std::int64_t kShortestRestUs = 200'000;
/// Left out next to the motion, for body sway and for the error of the truth's clock.
inline constexpr std::int64_t kSettlingUs = 50'000;

struct Rest {
  std::int64_t from_us = 0, to_us = 0;  // what was averaged over
  PlanarPose odometry;                  // mean pose in the odom frame
  /// Mean pose in the truth's frame; nothing if no sample in the stretch is valid. theta NaN if none has a
  /// heading.
  std::optional<PlanarPose> truth;
};

/// Nothing if the run does not stand still at that end for kShortestRestUs. Samples are in order of time;
/// truth before the first or after the last odometry sample does not count, as nobody knows whether the robot
/// moved.
std::optional<Rest> rest_at_start(const Run& run);
std::optional<Rest> rest_at_end(const Run& run);

}  // namespace astro::recording
