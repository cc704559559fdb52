#pragma once

#include <optional>
#include <span>
#include <vector>

/// A path on the floor as points: its length, how it turns, and whether positions and headings fit together; and what the
/// robot's wheels show: the unit of length, the offset of the clocks, and whether left and right are exchanged.
namespace astro::truth {

/// A position with a heading, NaN without one.
struct FloorPoint {
  double time_s = 0, x_m = 0, y_m = 0, theta_rad = 0;
  bool joined = true;  // with the point before; false behind a gap
};

/// An angle over time: a heading or the direction of a path, continuous.
struct TurningSample {
  double time_s = 0, angle_rad = 0;
  bool joined = true;  // with the sample before; false behind a gap
};
using Turning = std::vector<TurningSample>;

/// The heading at times that are at least 0.2 s apart, because noise of single samples would hide a slow turn.
Turning heading_turning(std::span<const FloorPoint> points);

/// The length between places that are a hundredth of the extent apart, so that noise at rest does not count.
double path_length(std::span<const FloorPoint> points);

/// Whether positions and headings have the same handedness, -1 to 1. A robot drives in a direction that is fixed in its own
/// frame. The measure is how much better that holds for the positions as they are than for their mirror image. About 0 if the
/// drive does not show it: a straight line, or positions without headings.
double handedness(std::span<const FloorPoint> points);

/// The motion of the robot by its wheels at a time of its own clock.
struct WheelMotion {
  double time_s = 0;
  double speed_mps = 0;       // forward positive
  double yaw_rate_radps = 0;  // counter-clockwise positive
};

/// How similarly two angles turn, -1 to 1: the correlation of their changes between the samples of `a`. The means are not
/// subtracted, so that a steady turn counts. `shift_s` is added to the times of `a`. 0 if nothing overlaps or turns.
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

/// Whether positions without headings lie as the wheels went (1), or as their mirror image (-1); near 0 if both do, as on a line.
/// Each stretch of some turns is compared with the way of a point on the robot, wherever it is: near the axle its direction of
/// motion turns against the robot where that begins and ends a spin.
double handedness(std::span<const FloorPoint> points, std::span<const WheelMotion> wheels,
                  const ClockMatch& clock);

/// Searches all offsets (calibration::search_clock) by speeds and turn rates. If the robot turned, the offset is then refined
/// by the turning alone, because a body that is not on the axle has another speed than the wheels. Nothing if the streams
/// hold no common motion, or one of them is longer than a day. `metres_per_unit`: of the points' positions.
std::optional<ClockMatch> match_clocks(std::span<const FloorPoint> points, double metres_per_unit,
                                       std::span<const WheelMotion> wheels);

}  // namespace astro::truth
