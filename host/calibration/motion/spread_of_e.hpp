#pragma once

namespace astro::calibration {

/// What is known of e before any drive: 0 +- 0.02. Two real robots have 0.015 and 0.031, rigid narrow wheels have 0; the root mean
/// square of the three is 0.02. The mean is 0 and not among them, so that drives which do not show e leave it at 0, and none
/// comes out further from 0 than its drives say.
inline constexpr double kSpreadOfE = 0.02;

}  // namespace astro::calibration
