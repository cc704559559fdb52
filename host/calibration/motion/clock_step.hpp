#pragma once

#include <optional>

#include "host/calibration/motion/clock_search.hpp"
#include "host/calibration/motion/trajectory.hpp"

/// A clock that somebody or something set anew while it stamped a drive, from the motion that both streams saw.
namespace astro::calibration {

struct ClockStep {
  double by_s = 0;  // the robot's clock less the tracker's: after the step, less before it
  /// The tracker's times between which it lies. The motion alone leaves this open where the speed does not change.
  double begin_s = 0, end_s = 0;
  bool sure = true;  // otherwise something else must show it as well (find_leap)
};

/// Looks for the one moment at which two offsets, one before and one after it, explain the motion certainly better than one
/// offset with any skew does. `clock` is that of the whole drive. Steps below 0.06 s are not told from noise, and steps
/// beyond 2.5 s not sought. Ground truth before and after the wheels' samples does not count.
///
/// Cost  1 ms for a minute; 0.2 s for an hour.
std::optional<ClockStep> find_clock_step(const Trajectory& run, const ClockFit& clock, double wheelbase_m);

}  // namespace astro::calibration
