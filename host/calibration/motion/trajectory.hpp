#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/base/pose2.hpp"

/// A whole drive as the estimator uses it: the travel of the wheels and the poses of the tracked body.
namespace astro::calibration {

/// Travel of each wheel since any start, in metres of a nominal wheel (c_R = c_L = 1): counts times pi times
/// the nominal diameter over the counts of a turn; forward positive. Robot's clock.
struct WheelSample {
  double time_s = 0;
  double left_m = 0, right_m = 0;
};

/// Pose of the tracked body in the tracker's frame, whatever its origin and direction. theta
/// counter-clockwise, wrapped or not; NaN where only the position was measured. The tracker's clock.
struct BodySample {
  double time_s = 0;
  double x_m = 0, y_m = 0, theta_rad = std::numeric_limits<double>::quiet_NaN();
};

/// The robot turned and its wheels did not, or not as far: it slipped or was kicked. Robot's clock.
struct Slip {
  double begin_s = 0, end_s = 0;
  double turn_rad = 0;  // counter-clockwise, that no wheel saw
};

/// One drive. Both streams in order of time; `truth` holds valid samples only and may have gaps.
struct Trajectory {
  std::string name;  // how messages call it: "run square cw 3 (before)"
  std::vector<WheelSample> wheels;
  std::vector<BodySample> truth;
  double wheel_turn_m = 0;  // travel of one turn of a nominal wheel; 0: not known
  std::string session =
      {};  // runs of equal names share lever arm and clocks; empty: found from the data (sessions.hpp)

  /// Only the poses before and after the drive were measured: `truth` has these two. They hold while the robot rests, so their
  /// times do not matter.
  bool ends_only = false;

  std::optional<double> started_s = {};  // when it was driven, in seconds since 1970; nothing if not known

  std::vector<Slip> slips = {};  // that are known, as from a gyro; in order of time
};

/// Pose of the tracked body in the robot frame (x forward, y left, origin midway between the wheels).
using LeverArm = Pose2;

/// The noise model of the estimator. A wheel that travels d is off by a normal error of variance K * |d|,
/// white along the path; the tracker's errors are white and normal per coordinate.
struct NoiseModel {
  double K_m = 2.645e-6;  // gives the scatter of the thesis's robot
  double sigma_xy_m = 5e-4;
  double sigma_theta_rad = 2.6e-3;
};

/// How a robot moves at a moment, by its wheels.
enum class Motion { rest, line, arc, spin };

}  // namespace astro::calibration
