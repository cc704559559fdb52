#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace astro::importing {

/// What is wrong with a parameter of a controller. Values: the file, the line and the text there.
enum class ControllerProblem { not_above_zero, zero };

/// The robot's parameters in a file for the diff_drive_controller of ROS 2 or ROS 1. The multipliers are those that were
/// loaded while the robot drove: a wheel's radius is wheel_radius times its multiplier, and below zero if its joint turns
/// backward when the robot drives forward.
struct DiffDriveParameters {
  std::string node;  // "diff_drive_controller", "/robot/base_controller"
  double wheel_radius_m = 0, wheel_separation_m = 0;
  double left_wheel_radius_multiplier = 1, right_wheel_radius_multiplier = 1, wheel_separation_multiplier = 1;
  bool open_loop = false;  // its odometry is made of commands
  std::vector<std::string> left_wheel_names, right_wheel_names;
};

/// The parameters of the controller `node`, or of the only one that has a wheel_radius or a wheel_separation.
/// `name` is the name of the file. Throws UnclearChoice (unclear_choice.hpp) if there is no such controller
/// or several, and astro::Error naming the file and the line if the text is not YAML or a value is not a
/// number above 0.
DiffDriveParameters diff_drive_parameters(std::string_view text, std::string_view name,
                                          std::string_view node = {});

}  // namespace astro::importing
