#pragma once

#include <optional>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// The lever arm of a tracked body of which only positions are known.
namespace astro::calibration {

/// With the robot dead-reckoned by `factors` to q, heading phi, the body is at z = t + r (q + l exp(i phi))
/// in the complex plane: linear in t, r and r l, so each piece of a drive of some radians gives l by least
/// squares, and the pieces are averaged with their information as weights. No start value, no iteration.
///
/// Yaw is zero, because positions do not determine it. Nothing if no piece has both lines and turns (a circle has
/// neither): spins alone do not determine the direction of l, and lines determine nothing of it.
/// Cost  linear.
std::optional<LeverArm> lever_of_positions(const PreparedRuns& runs, const WheelFactors& factors);

}  // namespace astro::calibration
