#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "host/base/error.hpp"
#include "host/experiment/analysis/calibration_file.hpp"

/// Exports a calibration for other programs.
namespace astro::experiment {

/// What the parameters of another program cannot express. Values of second_wheelbase: e, by how many percent gentle arcs are
/// turned wrong, whether too "far" or too "little", and the wheel_separation_multiplier that is right for them.
enum class ExportProblem { second_wheelbase };

/// The parameters of ROS 2's diff_drive_controller that a calibration determines. That controller moves a wheel
/// that turns by an angle phi by phi * wheel_radius * (its multiplier), and turns the robot by the difference
/// of both over wheel_separation * wheel_separation_multiplier.
///
/// Source  ros2_controllers, diff_drive_controller/src/odometry.cpp and diff_drive_controller.cpp.
struct DiffDrive {
  double wheel_radius_m = 0, wheel_separation_m = 0;  // nominal, as in a robot's URDF
  double left_wheel_radius_multiplier = 1, right_wheel_radius_multiplier = 1;
  double wheel_separation_multiplier = 1;
};

/// The nominal sizes in the receiving program.
struct NominalSizes {
  std::optional<double> wheel_radius_m;      // otherwise half of the file's wheel diameter
  std::optional<double> wheel_separation_m;  // otherwise the b that was loaded in the robot
};

/// Throws astro::Error for a parameter that a robot would refuse because of its limits, naming value, unit
/// and limits. Parameters that this version's table lacks are not checked.
void require_loadable(const ParameterFile& file);

/// Throws astro::Error if the file has no c_R, c_L or b or one that a robot would refuse, or if neither it
/// nor `nominal` gives a size.
DiffDrive diff_drive(const ParameterFile& file, const NominalSizes& nominal);

/// States what these parameters cannot express if e is not 0, because diff_drive_controller has only one wheelbase. They
/// contain the wheelbase of spins (b), which goes with c_R and c_L in a calibration, so gentle arcs are wrong by e. As sure of it
/// as the file's standard error of e allows (two_wheelbases). Nothing if e makes less than 0.05 %.
std::optional<Remark> single_wheelbase(const ParameterFile& file, const DiffDrive& parameters);

/// Whether ROS 2 accepts `name` as a node in a file of parameters: "controller", "/left_robot/controller".
///
/// Source  rmw, rmw/validate_node_name.h and validate_namespace.h.
bool is_ros2_node(std::string_view name);

/// A file for `--params-file` of a controller node called `node`; single_wheelbase is among its comments.
std::string ros2_yaml(const ParameterFile& file, const DiffDrive& parameters, const std::string& node);

/// The content of calib.toml at `path` and, if given, [diff_drive_controller].
std::string toml_text(const std::filesystem::path& path, const std::optional<DiffDrive>& parameters);

/// The same as JSON; numbers that do not exist are null.
std::string json_text(const std::filesystem::path& path, const std::optional<DiffDrive>& parameters);

}  // namespace astro::experiment
