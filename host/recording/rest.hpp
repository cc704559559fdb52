#pragma once

#include <optional>

#include "host/base/pose2.hpp"
#include "host/recording/run.hpp"

/// The rests at both ends of a run. The end error uses averages over them: a single tracker sample has noise
/// of about its resolution, the mean of n samples has 1/sqrt(n) of it.
namespace astro::recording {

/// At rest no wheel moves by more than this many counts: an encoder that rests on an edge flickers.
inline constexpr std::int32_t kStillCounts = 1;
/// A shorter stop is no rest: several frames of the slowest tracker (30 Hz) must fit into it.
inline constexpr std::int64_t kShortestRestUs = 200'000;
/// Left out next to the motion, because of body sway and the error of the truth's clock.
inline constexpr std::int64_t kSettlingUs = 50'000;

struct Rest {
  std::int64_t from_us = 0, to_us = 0;  // time span of the average
  Pose2 odometry;                       // mean pose in the odom frame
  /// Mean pose in the truth's frame; nothing if no sample of the rest is valid. theta NaN if none has a
  /// heading.
  std::optional<Pose2> truth;
};

/// Nothing if the robot is not at rest for kShortestRestUs at that end of the run. Samples are in order of
/// time; truth before the first or after the last odometry sample is ignored, because the robot may have
/// moved then.
std::optional<Rest> rest_at_start(const Run& run);
std::optional<Rest> rest_at_end(const Run& run);

}  // namespace astro::recording
