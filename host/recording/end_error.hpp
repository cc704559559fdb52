#pragma once

#include <string>

#include "host/base/pose2.hpp"
#include "host/recording/run.hpp"

namespace astro::recording {

/// Why a run has no ends that can be compared. Values: the run; then "start" or "end" (no_rest, no_truth).
enum class EndProblem { no_odometry, no_rest, no_truth, no_heading, never_moves };

/// The end of a run by ground truth and by odometry, each in the frame of its own start; theta of truth is NaN if truth has
/// no heading at the end, and neither is wrapped.
struct RunEnds {
  Pose2 absolute, odometry;
};

/// Start and end are means over the rests of the robot (rest.hpp), so that the noise of the tracker averages
/// out; truth may be in any frame. Throws astro::Error naming the run if it has no odometry, never moves, is
/// not at rest at an end, or has no valid truth there (at the start a heading is needed, too). `file`: how the user calls
/// the recording; "" if that is not known.
RunEnds ends_of(const Run& run, const std::string& file = "");

/// True end minus end by odometry, by coordinate; theta in [-pi, pi], NaN if truth has no heading at the end. The
/// input of UMBmark. Throws as ends_of does.
Pose2 end_error(const Run& run);

}  // namespace astro::recording
