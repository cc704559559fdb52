#pragma once

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Checks that wheels and ground truth have the same handedness, so that both turn the same way.
namespace astro::calibration {

/// Throws astro::Error naming the run for headings that never change although the wheels turn the robot;
/// headings counted clockwise; axes mirrored or wheels exchanged. A run that is too straight or too short to
/// decide passes.
void require_handedness(const PreparedRun& run, const ClockFit& clock, const WheelFactors& loaded);

}  // namespace astro::calibration
