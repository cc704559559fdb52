#pragma once

#include "host/calibration/end_poses/closed_form.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

namespace astro::calibration {

/// How often each direction was driven: the weights of the two means.
struct RunCounts {
  int cw = 0, ccw = 0;
};

/// The E_d and E_b whose exact replay (replay.hpp) comes closest to the measured end positions, in the sense
/// of the sum of squared distances over all runs. Headings are not used. The scale c_R + c_L stays as
/// loaded, because closed squares do not observe it.
///
/// Unlike umbmark_ratios it has no small-angle bias: noise-free end positions give the true ratios back.
/// Returns the ratios; alpha, beta and the curvature are those of the fitted robot.
/// Errors  throws astro::Error when the iteration does not settle, which only implausible end poses bring
/// about. Cost    Gauss-Newton, about 5 steps of 5 replays.
Ratios fit_end_positions(const MeanErrors& mean, RunCounts runs, double side_m, const WheelFactors& loaded);

}  // namespace astro::calibration
