#pragma once

#include "host/recording/run/run.hpp"

namespace astro::recording {

/// Where a run really ended, less where odometry says it ended, each seen from its own start: x forward, y
/// left at the start, theta counter-clockwise in [-pi, pi], NaN where truth has no heading at the end. The
/// raw material of UMBmark.
struct EndError {
  double x_m = 0, y_m = 0, theta_rad = 0;
};

/// Start and end are means over the stretches where the robot stands still (rest.hpp), so a truth frame of
/// any place and direction serves, and its noise averages out. Throws astro::Error naming the run if it has
/// no odometry, never moves, does not stand still at an end, or lacks valid truth there; a start without a
/// heading of truth counts as lacking it.
EndError end_error(const Run& run);

}  // namespace astro::recording
