#pragma once

#include <optional>
#include <span>

#include "host/base/error.hpp"
#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/end_poses/robust_fit.hpp"

namespace astro::calibration {

/// What is wrong with the measured ends as a whole, where each run agrees with the others of its direction (odd_run.hpp is about
/// single runs). To first order x, y and heading of a direction show one number, so that two centres have one shape for any
/// wheels and wheelbase. Nothing if the ends have it.
///
///   same_runs              both directions have the same numbers
///   misfit_with_mistake    a mistake that is easily made explains the ends: directions exchanged, a sign, x and y exchanged,
///                          degrees for radians, another side. Values: the mistakes that explain them equally well.
///   misfit                 none does
///
/// A mistake is named if it makes the ends e^15 times as likely: of 6400 honest experiments the most was e^8.
/// Single runs do not show so much. Signs that are wrong in all columns cannot be noticed: they are those of another robot.
std::optional<Remark> misfit_of(std::span<const EndPose> cw, std::span<const EndPose> ccw,
                                const SquareSetup& setup);

}  // namespace astro::calibration
