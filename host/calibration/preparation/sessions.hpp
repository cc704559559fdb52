#pragma once

#include <span>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

namespace astro::calibration {

/// Sets PreparedRun::session. The runs of a session are those between which nobody moved the tracked body on the robot or reset
/// its clock. Sessions are numbered from 0, in the order of their first runs.
///
/// Runs whose Trajectory::session is named belong together if the names are equal. The others are grouped by what the data
/// show by themselves: where the body sits (mounting.hpp) and the clock skew; what only all together show, the fit finds
/// (likelihood/moved_body.hpp). A run that shows neither belongs to the session of the drive that is nearest in time by the
/// tracker's clock, or to that of most runs if this clock began anew for each take. The order of the runs does not matter.
///
/// Cost  linear.
void find_sessions(PreparedRuns& runs, const WheelFactors& loaded);

/// The number of sessions.
int session_count(std::span<const PreparedRun> runs);

}  // namespace astro::calibration
