#pragma once

#include <span>
#include <vector>

#include "host/base/pose2.hpp"

/// End-pose errors of closed runs, the raw material of UMBmark.
namespace astro::calibration {

/// Error of one run at its end: absolute (ground truth) - odometry, in the run's start frame:
/// x forward, y left, theta counter-clockwise. theta is NaN where no heading was measured.
using EndPose = Pose2;

/// The figures of the thesis's tables for one direction, with the standard errors of the means.
///
/// se_r is hypot(se_x, se_y), the rms distance of the measured centre from the true one. The first-order
/// error along the direction of the centre would be smaller, and wrong after a calibration: then
/// the centre lies within its own scatter and has no defined direction. All are NaN for one run.
struct ClusterSummary {
  int runs = 0;
  double x_cg_m = 0, y_cg_m = 0, theta_cg_rad = 0;  // centre of gravity: mean over the runs
  double r_cg_m = 0;                                // hypot(x_cg, y_cg)
  double rms_x_m = 0, rms_y_m = 0, rms_r_m = 0, rms_theta_rad = 0;
  double se_x_m = 0, se_y_m = 0, se_theta_rad = 0, se_r_m = 0;
  bool has_theta = true;  // of at least one run
};

struct ExperimentSummary {
  ClusterSummary cw, ccw;
  double E_max_syst_m = 0;     // max(r_cg cw, r_cg ccw), Borenstein & Feng
  double se_E_max_syst_m = 0;  // of the cluster that is the maximum
};

/// Throws astro::Error if a set is empty or holds a value that is not finite.
/// A missing heading (NaN) is no error: the figures of theta are those of the runs with a heading.
ClusterSummary summarize(std::span<const EndPose> runs);
ExperimentSummary summarize(std::span<const EndPose> cw, std::span<const EndPose> ccw);

}  // namespace astro::calibration
