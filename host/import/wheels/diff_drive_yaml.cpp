#include "host/import/wheels/diff_drive_yaml.hpp"

#include <cmath>
#include <map>

#include "host/base/text/numbers.hpp"
#include "host/formats/files/yaml_scalars.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::importing {
namespace {

constexpr std::string_view kParameters = "ros__parameters";

/// "robot/base/ros__parameters/wheel_radius" has the node "robot/base" and the key "wheel_radius". ROS 1 has no
/// ros__parameters: there the key is the last name, with its number in a list.
struct Address {
  std::string node, key;
};

Address address_of(const std::string& path) {
  const std::size_t marker = path.find(kParameters);
  if (marker != std::string::npos && path.size() > marker + kParameters.size())
    return {path.substr(0, marker == 0 ? 0 : marker - 1), path.substr(marker + kParameters.size() + 1)};
  std::size_t slash = path.rfind('/');
  const bool in_list = slash != std::string::npos && slash > 0 && slash + 1 < path.size() &&
                       path.find_first_not_of("0123456789", slash + 1) == std::string::npos;
  if (in_list) slash = path.rfind('/', slash - 1);
  return slash == std::string::npos ? Address{"", path}
                                    : Address{path.substr(0, slash), path.substr(slash + 1)};
}

[[noreturn]] void refuse_scalar(const bag::YamlScalar& scalar, std::string_view name, const char* what,
                                ControllerProblem problem) {
  throw Error(std::string(name) + ", line " + std::to_string(scalar.line) + ": '" + scalar.value +
                  "' is no " + what + ": correct or replace it",
              problem, {std::string(name), std::to_string(scalar.line), scalar.value});
}

double positive(const bag::YamlScalar& scalar, std::string_view name) {
  const auto value = number_in(scalar.value);
  if (!value || !std::isfinite(*value) || *value <= 0)
    refuse_scalar(scalar, name, "number above 0", ControllerProblem::not_above_zero);
  return *value;
}

/// A multiplier of a wheel's radius: below zero for a joint that turns backward when the robot drives forward.
double not_zero(const bag::YamlScalar& scalar, std::string_view name) {
  const auto value = number_in(scalar.value);
  if (!value || !std::isfinite(*value) || *value == 0)
    refuse_scalar(scalar, name, "number other than 0", ControllerProblem::zero);
  return *value;
}

struct Controllers {
  std::map<std::string, DiffDriveParameters> by_node;

  void take(const bag::YamlScalar& scalar, std::string_view name) {
    const Address at = address_of(scalar.path);
    const auto controller = [&]() -> DiffDriveParameters& { return by_node[at.node]; };
    if (at.key == "wheel_radius") controller().wheel_radius_m = positive(scalar, name);
    if (at.key == "wheel_separation") controller().wheel_separation_m = positive(scalar, name);
    if (at.key == "left_wheel_radius_multiplier")
      controller().left_wheel_radius_multiplier = not_zero(scalar, name);
    if (at.key == "right_wheel_radius_multiplier")
      controller().right_wheel_radius_multiplier = not_zero(scalar, name);
    if (at.key == "wheel_separation_multiplier")
      controller().wheel_separation_multiplier = positive(scalar, name);
    if (at.key == "open_loop") controller().open_loop = scalar.value == "true" || scalar.value == "True";
    const auto is = [&](std::string_view ros2, std::string_view ros1) {
      return at.key.starts_with(ros2) || at.key == ros1 || at.key.starts_with(std::string(ros1) + '/');
    };
    if (is("left_wheel_names/", "left_wheel")) controller().left_wheel_names.push_back(scalar.value);
    if (is("right_wheel_names/", "right_wheel")) controller().right_wheel_names.push_back(scalar.value);
  }
};

}  // namespace

DiffDriveParameters diff_drive_parameters(std::string_view text, std::string_view name,
                                          std::string_view node) {
  Controllers controllers;
  for (const bag::YamlScalar& scalar : bag::yaml_scalars(text, name)) controllers.take(scalar, name);
  std::vector<std::string> nodes;
  for (const auto& [at, parameters] : controllers.by_node)
    if (parameters.wheel_radius_m > 0 || parameters.wheel_separation_m > 0) nodes.push_back(at);
  if (nodes.empty())
    throw UnclearChoice(std::string(name) + " has no wheel_radius and no wheel_separation of a controller",
                        nodes, WheelProblem::controller_unclear);
  if (node.empty() && nodes.size() > 1)
    throw UnclearChoice(std::string(name) + " has several controllers of wheels: " + listed(nodes), nodes,
                        WheelProblem::controller_unclear);
  const std::string chosen = node.empty() ? nodes.front() : std::string(node);
  const auto found = controllers.by_node.find(chosen);
  if (found == controllers.by_node.end())
    throw UnclearChoice(std::string(name) + " has no controller '" + chosen + "'; it has " + listed(nodes),
                        nodes, WheelProblem::controller_unclear);
  found->second.node = chosen;
  return found->second;
}

}  // namespace astro::importing
