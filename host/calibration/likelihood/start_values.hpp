#pragma once

#include <vector>

#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Start values of the search for the most likely parameters. Zeros are not good enough: with a wrong yaw of the tracked body
/// the search ends at negative wheel factors.
namespace astro::calibration {

/// Throws astro::Error if the runs never turn or never go straight.
void require_variety(const PreparedRuns& runs);

/// Factors and lever arm from relative poses (relative_pose.hpp) if truth has headings; otherwise the loaded
/// factors and the lever arm from positions (position_lever.hpp). One entry per run, with its own start pose
/// and clock. For data without noise they are already the result, except for the clocks.
///
/// Throws astro::Error if a wheel factor is negative.
std::vector<Unknowns> start_values(const PreparedRuns& runs, const WheelFactors& loaded);

/// The tracker's noise from its samples alone (tracker_noise.hpp), with a typical K.
NoiseModel start_noise(const PreparedRuns& runs);

}  // namespace astro::calibration
