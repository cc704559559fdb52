#pragma once

#include "host/recording/planar_pose.hpp"
#include "host/recording/run.hpp"

namespace astro::recording {

/// True end pose minus end pose by odometry, each in the frame of its own start: x forward, y left, theta
/// counter-clockwise in [-pi, pi], NaN if truth has no heading at the end. The input of UMBmark.
struct EndError {
  double x_m = 0, y_m = 0, theta_rad = 0;
};

/// The end of a run by ground truth and by odometry, each in the frame of its own start; theta of truth is NaN if truth has
/// no heading at the end, and neither is wrapped.
struct RunEnds {
  PlanarPose absolute, odometry;
};

/// Start and end are means over the rests of the robot (rest.hpp), so that the noise of the tracker averages
/// out; truth may be in any frame. Throws astro::Error naming the run if it has no odometry, never moves, is
/// not at rest at an end, or has no valid truth there (at the start a heading is needed, too).
RunEnds ends_of(const Run& run);

/// Their difference; throws as ends_of does.
EndError end_error(const Run& run);

}  // namespace astro::recording
