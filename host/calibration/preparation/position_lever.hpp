#pragma once

#include <optional>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Where on the robot a body sits whose positions alone are known.
namespace astro::calibration {

/// With the robot dead-reckoned by `factors` to q, heading phi, the body is at z = t + r (q + l exp(i phi))
/// in the complex plane: linear in t, r and r l, so each piece of a drive of some radians gives l by least
/// squares, and the mean over pieces counts each by what it tells. No start value, no iteration.
///
/// Yaw is zero, for positions do not tell it. Nothing where no piece has lines as well as turns (a circle has
/// neither): spins alone leave the direction of l open, lines all of it.
/// Cost  linear.
std::optional<LeverArm> lever_of_positions(const PreparedRuns& runs, const WheelFactors& factors);

}  // namespace astro::calibration
