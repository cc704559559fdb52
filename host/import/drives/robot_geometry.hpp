#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/import/wheels/joint_names.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// Why a drive of another program is refused, or what of it is not used. Values:
///   size_not_above_zero      the file and the parameter
///   given_twice              the file of the wheels
///   copy_of_other            both drives
///   turns_too_far, leaps     the drive, for a leap its metres, and the times in seconds before and after
///   below_origin             the drive, and by how many metres
///   turns_against_wheels     the drive, and by how many metres the body is above the tracker's origin if it
///                            clearly is
///   turns_against_stated_up  the drive
///   turns_against_exchanged  the drive, if its wheels were exchanged because a person said that they are in the file; also
///                            in place of below_origin
///   odometry_is_truth        the topic
///   odometry_of_commands     the topic
///   joints_backward          the drive, and left, right or both
///   no_poses                 the file of the ground truth, and how many poses it has
///   time_unit_doubtful       the file, the unit that was assumed, and the seconds that the drive lasts by it and by the other file
enum class ImportProblem {
  size_not_above_zero,
  sizes_not_described,
  sizes_not_used,
  given_twice,
  copy_of_other,
  no_wheelbase,
  no_wheel_diameter,
  no_counts_per_turn,
  turns_too_far,
  leaps,
  below_origin,
  turns_against_wheels,
  turns_against_stated_up,
  turns_against_exchanged,
  up_axis_of_other,
  wheels_stand,
  wheel_stands,
  wheels_equal,
  per_interval_likely,
  encoders_reversed,
  drives_backward,
  odometry_is_truth,
  odometry_of_commands,
  joints_backward,
  no_poses,
  times_not_increasing,
  time_unit_doubtful
};

/// The wheels of any robot as its own program describes them: nominal sizes, and the factors by which its
/// odometry multiplied them while it drove.
struct RobotGeometry {
  std::optional<double> wheel_diameter_m, counts_per_turn, wheelbase_m;
  double c_r = 1, c_l = 1;
  double e = 0, kappa0 = calibration::kUsualKappa0;
  bool left_backward = false, right_backward = false;  // the joint turns so when the robot drives forward
  bool open_loop = false;                              // its odometry is made of commands
  JointPair joints;                                    // "" unless the file names the wheels' joints
  std::string name, id;                                // of the robot, "" if unknown

  /// The factors of its odometry. Precondition: the wheelbase is known.
  calibration::WheelFactors factors() const { return {c_r, c_l, *wheelbase_m, e, kappa0}; }
  /// This geometry with the sizes and joints that `over` has in place of its own.
  RobotGeometry overridden_by(const RobotGeometry& over) const;
};

/// Whether read_robot_file reads the file as YAML. Throws astro::Error naming the file if it cannot be read.
bool is_controller_file(const std::filesystem::path& path);

/// Reads the geometry in a file. The kind is recognised by the content:
///   TOML   [parameters] wheel_diameter, counts_per_motor_rev, gear_numerator, gear_denominator (1 unless given), b, c_R,
///          c_L, e, kappa0, in SI units: as the robot's parameters are exported; or a calibration that the robot carries, with
///          its [nominal] wheel
///   YAML   parameters of ROS 2's diff_drive_controller; `node` chooses among several. Its multipliers are c_R and c_L (below
///          zero: the joint turns backward), and the wheelbase is wheel_separation times its multiplier.
///
/// Throws astro::Error naming the file if it cannot be read, and importing::UnclearChoice if it is unclear
/// which node is meant.
RobotGeometry read_robot_file(const std::filesystem::path& path, const std::string& node = {});

/// The parameters with which a robot computes the same odometry from its counts as the program whose geometry
/// this is: c_R, c_L, b, e, and wheel_diameter if it is known. Throws astro::Error naming the file if the
/// wheelbase is not known.
experiment::ParameterValues parameters_of(const RobotGeometry& geometry, const std::filesystem::path& path);

/// Returns `geometry` if it has all that travel in this unit needs: a wheelbase, the wheel diameter (also for
/// metres, because c_R and c_L refer to it), and for counts their number in a turn. Throws astro::Error
/// naming what is missing.
RobotGeometry complete_geometry(RobotGeometry geometry, WheelUnit unit);

}  // namespace astro::importing
