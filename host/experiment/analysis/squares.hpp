#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/end_poses/line_scale.hpp"
#include "host/calibration/end_poses/odd_run.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/recording/run.hpp"

/// From recordings to the end errors of squares and the lengths of lines, and to the factors with which they were driven.
namespace astro::experiment {

/// All squares that were driven with one set of parameters, and the lines beside them.
struct Squares {
  std::vector<calibration::EndPose> cw, ccw;
  double side_m = 0;
  calibration::WheelFactors loaded;
  std::vector<calibration::LineEnd> lines;  // forwards, with a measured end
  /// For each square that was left out: which, and why.
  std::vector<std::string> left_out;
  /// Where each of `cw` and `ccw` is from, at the beginning of a sentence: "cw.csv, line 3". Empty if that is not known.
  std::vector<std::string> cw_from, ccw_from;
};

/// The squares among `runs`. A square is left out if a person entered its end (not has_moving_truth), it does not fit the
/// others (calibration::odd_runs), and at least three of its direction remain. A square with truth from a tracker is never
/// left out, because it contains no typing error: then the robot did behave like that.
///
/// `files`: how the user calls the recordings; empty if that is not known.
///
/// Throws astro::Error if there are no squares, or if they differ in side or in the parameters that were loaded in the
/// robot: such runs must not be averaged; and what recording::ends_of throws.
Squares squares_of(std::span<const recording::Run> runs, std::span<const std::string> files = {});

/// The end of a line as measured and by odometry; nothing if the run is no line forwards, or if its end is not known.
std::optional<calibration::LineEnd> line_of(const recording::Run& run, const std::string& file = "");

/// The end of a run; NaN where it cannot be computed: then the calibration reports why.
calibration::SquareEnd square_end(const recording::Run& run);

/// Whether a robot cannot tell `a` from `b`: they differ by less than the wire format resolves.
bool same_factors(const calibration::WheelFactors& a, const calibration::WheelFactors& b);

/// The factors that were loaded in a run's robot; throws astro::Error where the recording does not say. A robot that
/// knows no e has e = 0. `file`: as in loaded_parameter.
calibration::WheelFactors loaded_factors(const recording::RunInfo& info, const std::string& file = "");

/// The factors that were loaded in all runs; throws astro::Error where they differ (same_factors), or where a recording
/// does not say. Precondition: at least one run.
calibration::WheelFactors loaded_in_all(const RunSet& set);

}  // namespace astro::experiment
