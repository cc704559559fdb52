#pragma once

#include <span>

#include "host/calibration/end_poses/line_scale.hpp"
#include "host/calibration/end_poses/umbmark.hpp"
#include "host/calibration/judgement/cross_validation.hpp"

/// Cross-validation of what end poses and measured lines say.
namespace astro::calibration {

/// Judges factors from end poses of squares: one square of each direction is held out at a time, and what the other
/// squares say of its end is compared with where it ended. The scatter of the ends within their direction is taken for
/// their noise. Nothing is judged with fewer than two squares in a direction.
CrossValidation cross_validate(std::span<const EndPose> cw, std::span<const EndPose> ccw, double side_m,
                               const WheelFactors& in_use, const Options& options);

/// Adds the scale that lines gave to what squares said: one line is held out at a time, and its length foretold by the scale of
/// the others. `scale`: of all lines. The scale of a single line is not judged.
void cross_validate_scale(std::span<const LineEnd> lines, const WheelFactors& in_use, const LineScale& scale,
                          CrossValidation& judged);

}  // namespace astro::calibration
