#pragma once

#include <optional>
#include <span>

#include "host/truth/floor/floor_points.hpp"

/// What the robot's wheels know about a track on the floor: the unit of length, the offset of the clocks, and
/// whether left and right are exchanged.
namespace astro::truth {

/// The motion of the robot by its wheels at a time of its own clock.
struct WheelMotion {
  double time_s = 0;
  double speed_mps = 0;       // forward positive
  double yaw_rate_radps = 0;  // counter-clockwise positive
};

/// How alike two angles turn, -1 to 1: the correlation of their changes between the samples of `a`, not about the
/// means, so that a steady turn counts. `shift_s` is added to the times of `a`. 0 where nothing overlaps or turns.
double turning_correlation(const Turning& a, const Turning& b, double shift_s = 0, double skew = 0,
                           double middle_s = 0);

/// The heading by the wheels.
Turning turning_of(std::span<const WheelMotion> wheels);

/// The way that the wheels went, forward and backward added up.
double path_length(std::span<const WheelMotion> wheels);

/// The clocks: robot's time = tracker's time + offset_s + skew * (tracker's time - middle_s).
struct ClockMatch {
  double offset_s = 0, skew = 0, middle_s = 0;
  double correlation = 0;  // of the motions, without regard to the direction of turning
};

/// Searches all offsets (calibration::search_clock) by speeds and turn rates. If the robot turned, the offset is then
/// set to where the turning alone agrees best, because the speed of a body beside the axle is not that of the wheels.
/// Nothing if the streams hold no common motion, or one of them is longer than a day. `metres_per_unit`: of the points' positions.
std::optional<ClockMatch> match_clocks(std::span<const FloorPoint> points, double metres_per_unit,
                                       std::span<const WheelMotion> wheels);

}  // namespace astro::truth
