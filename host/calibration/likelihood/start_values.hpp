#pragma once

#include <vector>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Where the search for the likeliest parameters begins. Never at zero: a wrong yaw of the tracked body would
/// lead to negative wheels.
namespace astro::calibration {

/// Throws astro::Error when the runs never turn or never go straight.
void require_variety(const PreparedRuns& runs);

/// Factors and lever arm from relative poses (relative_pose.hpp) where truth has headings; else factors as
/// carried and the lever arm from positions (position_lever.hpp). One entry per run, with its own start pose
/// and clock. All but the clocks are what the search would find if there were no noise.
///
/// Throws astro::Error when a wheel comes out negative.
std::vector<Unknowns> start_values(const PreparedRuns& runs, const WheelFactors& carried);

/// The tracker's noise from its samples alone (tracker_noise.hpp); K as usual.
NoiseModel start_noise(const PreparedRuns& runs);

}  // namespace astro::calibration
