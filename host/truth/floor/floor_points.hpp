#pragma once

#include <span>
#include <vector>

/// A path on the floor as points: its length, how it turns, and whether positions and headings fit together.
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

/// The direction in which the points go, between places that are a hundredth of the path's extent apart.
/// `both_ways`: the robot also drives backward, which is the same direction; then a turn by more than a right angle
/// between two places is misread.
Turning path_turning(std::span<const FloorPoint> points, bool both_ways);

/// The heading at times that are at least 0.2 s apart, because noise of single samples would hide a slow turn.
Turning heading_turning(std::span<const FloorPoint> points);

/// The length between places that are a hundredth of the extent apart, so that noise at rest does not count.
double path_length(std::span<const FloorPoint> points);

/// Whether positions and headings have the same handedness, -1 to 1. A robot goes in a direction that is fixed in its
/// own frame: the measure is by how much better that holds for the positions as they are than for their mirror image.
/// About 0 if the drive does not show it: a straight line, or positions without headings.
double handedness(std::span<const FloorPoint> points);

}  // namespace astro::truth
