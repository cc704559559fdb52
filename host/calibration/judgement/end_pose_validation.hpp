#pragma once

#include <span>

#include "host/calibration/end_poses/line_scale.hpp"
#include "host/calibration/end_poses/umbmark.hpp"
#include "host/calibration/judgement/cross_validation.hpp"

/// Cross-validation of factors from end poses and of a scale from measured lines.
namespace astro::calibration {

/// Judges factors from end poses of squares: one square of each direction is held out at a time, and its end is compared with
/// the prediction from the other squares. The scatter of the ends within their direction is taken as the noise. Nothing is
/// judged if a direction has fewer than two squares.
CrossValidation cross_validate(std::span<const EndPose> cw, std::span<const EndPose> ccw, double side_m,
                               const WheelFactors& in_use, const Options& options);

/// Adds the cross-validation of the scale: one line is held out at a time, and its length is predicted with the scale of the
/// others. `scale`: from all lines. The scale of a single line is not judged.
void cross_validate_scale(std::span<const LineEnd> lines, const WheelFactors& in_use, const LineScale& scale,
                          CrossValidation& judged);

}  // namespace astro::calibration
