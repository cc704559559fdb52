#pragma once

#include <span>

namespace astro::motor {

/// The usual figures of a step response.
struct StepFigures {
  double rise_s = 0;           // from 10 % to 90 % of the final set point; NaN if it is never reached
  double overshoot = 0;        // peak over final set point, minus one; not below 0
  double worst_error_mps = 0;  // of speed against set point, at any time
  double rms_error_mps = 0;
};

/// Series of equal length: times in order, set points and speeds. The final set point is the last.
StepFigures step_figures(std::span<const double> time_s, std::span<const double> set_point_mps,
                         std::span<const double> speed_mps);

}  // namespace astro::motor
