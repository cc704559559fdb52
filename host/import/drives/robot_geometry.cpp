#include "host/import/drives/robot_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <variant>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/experiment/files/curvature_named.hpp"
#include "host/import/wheels/diff_drive_yaml.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;

/// Decides by the first line that is neither empty nor a comment: TOML begins with a [table] or `key =`, YAML
/// with `key:`, with the three dashes that begin a document or with a %directive.
bool looks_like_yaml(std::string_view text) {
  const std::string document(3, '-');
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty() || line.front() == '#') continue;
    if (line.front() == '[') return false;
    if (line.starts_with(document) || line.front() == '%') return true;
    return line.find(':') < line.find('=');
  }
  return false;
}

RobotGeometry of_controller(std::string_view text, const fs::path& path, const std::string& node) {
  const DiffDriveParameters found = diff_drive_parameters(text, path.string(), node);
  RobotGeometry geometry;
  if (found.wheel_radius_m > 0) geometry.wheel_diameter_m = 2 * found.wheel_radius_m;
  if (found.wheel_separation_m > 0)
    geometry.wheelbase_m = found.wheel_separation_m * found.wheel_separation_multiplier;
  geometry.c_r = std::abs(found.right_wheel_radius_multiplier);
  geometry.c_l = std::abs(found.left_wheel_radius_multiplier);
  geometry.right_backward = found.right_wheel_radius_multiplier < 0;
  geometry.left_backward = found.left_wheel_radius_multiplier < 0;
  geometry.open_loop = found.open_loop;
  // If a side has several wheels, the first one represents them, because they turn together.
  if (!found.left_wheel_names.empty() && !found.right_wheel_names.empty())
    geometry.joints = {found.left_wheel_names.front(), found.right_wheel_names.front()};
  return geometry;
}

RobotGeometry of_parameters(const fs::path& path) {
  const experiment::ParameterFile file = experiment::read_parameter_file(path);
  const auto number = [&](const char* name) -> std::optional<double> {
    const auto found = file.parameters.find(name);
    if (found == file.parameters.end()) return std::nullopt;
    const double* value = std::get_if<double>(&found->second);
    if (value == nullptr || !(*value > 0))
      throw Error(fmt::format("'{}': [parameters] {} is not a number above 0: correct or replace it",
                              path.string(), name),
                  ImportProblem::size_not_above_zero, {path.string(), name});
    return *value;
  };
  RobotGeometry geometry;
  geometry.wheel_diameter_m = number("wheel_diameter");
  if (const auto counts = number("counts_per_motor_rev"))
    geometry.counts_per_turn =
        *counts * number("gear_numerator").value_or(1) / number("gear_denominator").value_or(1);
  geometry.wheelbase_m = number("b");
  geometry.c_r = number("c_R").value_or(1);
  geometry.c_l = number("c_L").value_or(1);
  const calibration::WheelFactors curved =
      experiment::with_curvature_named({}, file.parameters, fmt::format("'{}'", path.string()));
  geometry.e = curved.e;
  geometry.kappa0 = curved.kappa0;
  if (file.wheel && !geometry.wheel_diameter_m) {
    geometry.wheel_diameter_m = file.wheel->diameter_m;
    if (!file.wheel->turns_as_angle()) geometry.counts_per_turn = file.wheel->counts_per_turn;
  }
  geometry.name = file.robot.name;
  geometry.id = file.robot.id;
  return geometry;
}

}  // namespace

RobotGeometry RobotGeometry::overridden_by(const RobotGeometry& over) const {
  RobotGeometry result = *this;
  if (over.wheel_diameter_m) result.wheel_diameter_m = over.wheel_diameter_m;
  if (over.counts_per_turn) result.counts_per_turn = over.counts_per_turn;
  if (over.wheelbase_m) result.wheelbase_m = over.wheelbase_m;
  if (!over.joints.left.empty()) result.joints = over.joints;
  return result;
}

bool is_controller_file(const fs::path& path) {
  return looks_like_yaml(as_text(load_file(path, kMaxSettingsBytes)));
}

RobotGeometry read_robot_file(const fs::path& path, const std::string& node) {
  const Bytes bytes = load_file(path, kMaxSettingsBytes);
  const std::string_view text = as_text(bytes);
  return looks_like_yaml(text) ? of_controller(text, path, node) : of_parameters(path);
}

experiment::ParameterValues parameters_of(const RobotGeometry& geometry, const fs::path& path) {
  if (!geometry.wheelbase_m)
    throw Error("'" + path.string() + "' has no wheel_separation: name another file");
  experiment::ParameterValues values{
      {"c_R", geometry.c_r}, {"c_L", geometry.c_l}, {"b", *geometry.wheelbase_m}, {"e", geometry.e}};
  if (geometry.wheel_diameter_m) values["wheel_diameter"] = *geometry.wheel_diameter_m;
  return values;
}

RobotGeometry complete_geometry(RobotGeometry geometry, WheelUnit unit) {
  if (!geometry.wheelbase_m)
    throw Error("the wheelbase of the robot is not known", ImportProblem::no_wheelbase);
  if (!geometry.wheel_diameter_m)
    throw Error("the diameter of the robot's wheels is not known", ImportProblem::no_wheel_diameter);
  if (!geometry.counts_per_turn && unit == WheelUnit::counts)
    throw Error("how many counts make a turn of the wheel is not known", ImportProblem::no_counts_per_turn);
  return geometry;
}

}  // namespace astro::importing
