#pragma once

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Whether wheels and ground truth turn the same way.
namespace astro::calibration {

/// Throws astro::Error naming the run for headings that never change although the wheels turn the robot;
/// headings counted clockwise; axes mirrored or wheels exchanged. A run too straight, or too short, to tell
/// passes.
void require_senses(const PreparedRun& run, const ClockFit& clock, const WheelFactors& carried);

}  // namespace astro::calibration
