#pragma once

#include <vector>

#include "common/protocol/motion.hpp"
#include "host/base/text/sense.hpp"

/// Paths as segments for the robot's queue. Angles that are dyadic fractions of a turn are exact (a
/// quarter turn is 2^30), lengths are rounded to 1 nm. Left and counter-clockwise are positive.
///
/// Errors  astro::Error where a number is not finite or outside what a segment can hold.
namespace astro::robot {

using Path = std::vector<protocol::AddSegment>;

/// Speed limits; 0: the robot's own limit.
struct PathLimits {
  double speed_mps = 0;
  double yaw_rate_radps = 0;
};

constexpr double turns_from_degrees(double degrees) { return degrees / 360; }

/// Straight ahead; backwards if negative.
Path line(double length_m, PathLimits limits = {});

/// Turns on the spot.
Path spin(double turns, PathLimits limits = {});

/// The robot's centre moves along `length_m` while the heading changes by `turns`; backwards if the length is
/// negative.
Path arc(double length_m, double turns, PathLimits limits = {});

/// `turns` times round a centre beside the start, as one arc.
Path circle(double radius_m, double turns, Sense sense, PathLimits limits = {});

/// Four times a side and a quarter turn on the spot; ends in the pose where it began. cw turns right.
Path square(double side_m, Sense sense, PathLimits limits = {});

}  // namespace astro::robot
