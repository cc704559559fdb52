#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/end_poses/replay.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// Drives of a robot that is kinematics and noise alone, as input of a calibration; its true factors are
/// known. Much faster than the simulated robot, and exactly the model that maximum likelihood assumes.
namespace astro::simulation::study {

/// One piece of a course, as the robot's odometry measures it.
struct Leg {
  enum class Kind { rest, straight, turn };
  Kind kind = Kind::rest;
  double length_m = 0;    // straight: signed; turn: arc length of the centre, 0 for a spin
  double angle_rad = 0;   // turn: counter-clockwise positive
  double duration_s = 0;  // rest
};

using Course = std::vector<Leg>;

/// Rest, then the path, then rest again; each rest of `rest_s`. Distances in metres, angles in radians.
Course square_course(double side_m, Sense sense, double rest_s = 1);
/// A square with a stand after each spin. A line follows the last stand, because the wind-up of a spin is
/// released only in the next line.
inline constexpr double kStand_s = 1, kEndLine_m = 0.3;
Course square_course_with_stands(double side_m, Sense sense, double rest_s = 1);
Course line_course(double length_m, double rest_s = 1);
Course spin_course(double angle_rad, double rest_s = 1);
Course circle_course(double radius_m, double angle_rad, double rest_s = 1);

/// How the course is driven and observed.
struct DriveModel {
  calibration::WheelFactors loaded;  // loaded in the robot, which uses them to follow the course
  calibration::WheelFactors actual;  // the true ones
  /// The part of the heading that tyres and castor hold back in a spin. It is still held while the robot
  /// stands after the spin, and released within millimetres of the next line.
  double windup_rad = 0;
  calibration::NoiseModel noise;
  calibration::LeverArm lever;
  double speed_mps = 0.3, acceleration_mps2 = 0.5;
  double yaw_rate_radps = 1.0, yaw_acceleration_radps2 = 2.0;
  double count_rate_hz = 100, truth_rate_hz = 60;
  double metres_per_count = 0;  // of a nominal wheel; 0: counts are not rounded
  bool headings = true;         // truth has headings
  double clock_offset_s = 0;    // robot's clock minus tracker's, in the middle of the run
  double clock_skew = 0;        // the robot's clock runs (1 + skew) times as fast
};

/// The drive as it would have been recorded. Equal seeds give equal drives.
/// Errors  none; rates, speeds and accelerations are positive.
/// Cost    about 2 ms for a minute.
calibration::Trajectory synthetic_drive(const Course& course, const DriveModel& model,
                                        const std::string& name, std::uint64_t seed);

/// The end pose error for UMBmark: truth minus odometry by `loaded`, both averaged over the rests at the
/// ends. For a body without lever arm, and with headings.
calibration::EndPose end_error(const calibration::Trajectory& run, const calibration::WheelFactors& loaded,
                               double rest_s = 1);

/// A seed for part `index` of something seeded with `seed`. Neighbouring numbers give independent streams.
std::uint64_t derived_seed(std::uint64_t seed, std::uint64_t index);

}  // namespace astro::simulation::study
