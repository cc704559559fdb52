#pragma once

#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// Exact-arc replay of a square: where a robot really ends if its odometry says that it is back at the start.
namespace astro::calibration {

/// Four times a leg of `side_m` and a spin of a quarter turn. The robot drives so that its odometry with the
/// factors `odometry` closes exactly, while its real wheels and wheelbase are `truth`. There is no noise, no
/// slip and no dynamics: each leg and each spin is one arc of constant twist.
///
/// Returns the end-pose error, absolute - odometry, in the start frame; heading not wrapped.
/// Errors  none; the factors and the side are positive and finite.
/// Cost    two arcs, and four sides joined; about a quarter of a microsecond.
EndPose replay_square(double side_m, Sense sense, const WheelFactors& odometry, const WheelFactors& truth);

/// max(r cw, r ccw) of the two replays: the remaining systematic error, in metres.
double replay_E_max_syst_m(double side_m, const WheelFactors& odometry, const WheelFactors& truth);

}  // namespace astro::calibration
