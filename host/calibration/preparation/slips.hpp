#pragma once

#include <memory>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/prepared_run.hpp"

/// Slips that are known (Trajectory::slips), left out of the fit.
namespace astro::calibration {

/// The drive with wheels that turn the robot by each slip as well, evenly along it, so that dead reckoning goes on in the right
/// direction; nothing if it has no slips. `loaded` need only be roughly right.
std::shared_ptr<const Trajectory> turned_by_slips(const Trajectory& run, const WheelFactors& loaded);

/// The stretches of the slips, in the order of their times: no truth within them is used, and place and heading are open after them.
std::vector<WheelGap> gaps_of_slips(const Trajectory& run);

/// Both in the order of their times; those that overlap are one, behind which what both leave open is open.
std::vector<WheelGap> joined(std::vector<WheelGap> gaps, const std::vector<WheelGap>& more);

}  // namespace astro::calibration
