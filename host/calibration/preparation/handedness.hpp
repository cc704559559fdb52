#pragma once

#include <span>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Checks that wheels and ground truth have the same handedness, so that both turn the same way.
namespace astro::calibration {

/// Throws astro::Error naming the run for headings that never change although the wheels turn the robot;
/// headings counted clockwise; axes mirrored or wheels exchanged. A run that is too straight or too short to
/// decide passes.
void require_handedness(const PreparedRun& run, const ClockFit& clock, const WheelFactors& loaded);

/// The same of the drives among these of which only the ends were measured (Trajectory::ends_only). One alone decides nothing: a
/// heading at the end fits a turn either way by some whole turns. Throws naming the first of them.
void require_handedness_of_ends(std::span<const PreparedRun> runs, const WheelFactors& loaded);

}  // namespace astro::calibration
