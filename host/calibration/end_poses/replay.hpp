#pragma once

#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// Exact-arc replay of a square: where a robot really ends that believes it has come back to its start.
namespace astro::calibration {

/// Which way round: the four spins are turned to the right (cw) or to the left (ccw).
enum class Sense { cw, ccw };

/// Four times a leg of `side_m` and a spin of a quarter turn, driven so that the odometry of a robot that
/// carries `believed` closes exactly, by a robot whose wheels and wheelbase are `truth`. No noise, no slip,
/// no dynamics: each leg and each spin is one arc of constant twist.
///
/// Returns the end-pose error, absolute - odometry, in the start frame; heading not wrapped.
/// Errors  none; the factors and the side are positive and finite.
/// Cost    eight arcs; about a microsecond.
EndPose replay_square(double side_m, Sense sense, const WheelFactors& believed, const WheelFactors& truth);

/// max(r cw, r ccw) of the two replays: what is left of the systematic error, in metres.
double replay_E_max_syst_m(double side_m, const WheelFactors& believed, const WheelFactors& truth);

}  // namespace astro::calibration
