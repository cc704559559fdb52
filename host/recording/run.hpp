#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/text/sense.hpp"
#include "host/lidar/scan.hpp"

/// One drive as it was recorded: odometry and ground truth.
///
/// Frames  odometry: the robot's odom frame. truth: the tracker's frame. theta is counter-clockwise; the odom
///         frame has x forward and y left at the robot's start. The two frames are not related; only the
///         motion is the same.
/// Times   microseconds on the robot's clock, both streams (`truth_clock` says how truth got there).
namespace astro::recording {

/// The pose by wheels and gyro. A stream of its own, because most robots have none: it costs no memory in their samples.
struct GyroPose {
  std::int64_t time_us = 0;
  double x_m = 0, y_m = 0, theta_rad = 0;  // theta continuous, not wrapped
  /// Mean yaw rate by the gyro over 10 ms, less a bias that is the same in the whole recording: the one that the robot knew when it
  /// began. NaN while the gyro measures none.
  double omega_radps = 0;
};

struct OdometrySample {
  std::int64_t time_us = 0;
  double x_m = 0, y_m = 0, theta_rad = 0;          // theta continuous, not wrapped
  double v_mps = 0, omega_radps = 0;               // measured body twist
  std::int32_t left_counts = 0, right_counts = 0;  // running encoder counts, forward positive, wrap at 2^32
};

/// The gyro noticed that the robot turned without its wheels: a kick, or a wheel that slipped.
struct GyroSlip {
  std::int64_t time_us = 0;
  double turn_rad = 0;  // counter-clockwise, so far
};

/// What a gyro said, as a drive of other programs has it: about the robot's vertical axis, counter-clockwise, with its bias.
struct YawRate {
  std::int64_t time_us = 0;
  double rate_radps = 0;
};

struct TruthSample {
  std::int64_t time_us = 0;
  double x_m = 0, y_m = 0, theta_rad = 0;  // theta continuous, not wrapped
  bool valid = true;                       // false: the tracker had lost the body, and the pose means nothing
};

struct RunInfo {
  std::string kind;                // "square", "line", "spin", "circle", "free"
  std::optional<Sense> direction;  // none: of a path that does not turn one way
  std::string phase;               // "before", "after", "repeat-1", ... or "" for a free recording
  int index = 0;                   // 1, 2, ... within its kind, direction and phase
  double size_m = 0;               // square: side; circle: radius; line: length; spin: 0
  double speed_mps = 0;
  std::string robot_name, robot_id, board, firmware;
  std::string started_at;    // ISO 8601, UTC
  std::string truth_source;  // "sim", "manual", "file", "lidar", "" if none
  std::string truth_clock;   // "robot"; "host": mapped from the recording computer's
  /// Identifies the film that the truth is from by its content (film_track.hpp); "" if there is none.
  std::string truth_film = {};
  /// Standard error of the common factor of all lengths in the truth, which no drive shows: 0 where a tracker is calibrated;
  /// infinite where nobody measured a length.
  double truth_scale_sigma = 0;
  /// The parameters that were loaded in the robot while it drove, SI values by table name: c_R, c_L, b, ...
  std::map<std::string, double> parameters;
};

struct Run {
  RunInfo info;
  std::vector<OdometrySample> odometry;
  std::vector<TruthSample> truth;
  /// What the file has lost. Its first value is the file; its kind is RecordingProblem::cut_off or, for a damaged file that was
  /// accepted, that of DamagedRecording.
  std::optional<Remark> warning = {};
  /// Of a laser scanner on the robot, on the robot's clock; the place of the scanner is not known.
  std::vector<lidar::Scan> scans = {};
  std::vector<GyroSlip> slips = {};
  std::vector<GyroPose> gyro = {};  // in order of time; none of a robot that uses no gyro
  /// In order of time; only of drives that other programs recorded. Not stored.
  std::vector<YawRate> yaw_rates = {};
};

}  // namespace astro::recording
