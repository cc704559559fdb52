#pragma once

#include <span>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

namespace astro::calibration {

/// Sets PreparedRun::session: runs between which nobody moved the tracked body on the robot or set up its clock anew. They are
/// numbered from 0, in the order of their first runs.
///
/// Runs whose Trajectory::session is named belong together if the names are equal. The others are sorted by what they show
/// themselves: where the body sits (mounting.hpp) and how much faster one clock runs than the other. A run that shows neither
/// belongs to the session of the run before it.
///
/// Cost  linear.
void find_sessions(PreparedRuns& runs, const WheelFactors& loaded);

/// How many there are.
int session_count(std::span<const PreparedRun> runs);

}  // namespace astro::calibration
