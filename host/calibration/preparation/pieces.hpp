#pragma once

#include <vector>

#include "host/calibration/preparation/preparation.hpp"
#include "host/calibration/preparation/relative_pose.hpp"

namespace astro::calibration {

/// A run with headings as relative poses, each long enough to exceed the tracker's noise, and short enough that there are many.
/// `wheelbase_m` need only be roughly right.
std::vector<RelativePose> pieces_of(const PreparedRun& run, const ClockFit& clock, double wheelbase_m);

}  // namespace astro::calibration
