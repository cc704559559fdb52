#include "host/formats/messages/robot_model.hpp"

#include <cmath>
#include <numbers>

#include "host/base/text/numbers.hpp"
#include "host/formats/messages/ros_messages.hpp"

namespace astro::ros2 {
namespace {

double parameter(const std::map<std::string, double>& all, const char* name) {
  const auto found = all.find(name);
  return found == all.end() || !std::isfinite(found->second) ? 0 : found->second;
}

std::string wheel_link(const std::string& name, double radius_m) {
  return "<link name=\"" + name + "\"><visual><origin rpy=\"" + to_text(std::numbers::pi / 2) +
         " 0 0\"/><geometry><cylinder radius=\"" + to_text(radius_m) + "\" length=\"" +
         to_text(radius_m / 2) + "\"/></geometry></visual></link>";
}

std::string wheel_joint(const std::string& name, const std::string& parent, const std::string& child,
                        double y_m, double radius_m) {
  return "<joint name=\"" + name + "\" type=\"continuous\"><parent link=\"" + parent + "\"/><child link=\"" +
         child + "\"/><origin xyz=\"0 " + to_text(y_m) + " " + to_text(radius_m) +
         "\"/><axis xyz=\"0 1 0\"/></joint>";
}

std::string footprint_link(const std::string& name, const std::string& base) {
  return "<link name=\"" + name + "\"/><joint name=\"base_joint\" type=\"fixed\"><parent link=\"" + name +
         "\"/><child link=\"" + base + "\"/></joint>";
}

}  // namespace

RobotModel::RobotModel(const std::map<std::string, double>& parameters)
    : radius_m(parameter(parameters, "wheel_diameter") / 2), separation_m(parameter(parameters, "b")) {
  const double counts_per_turn = parameter(parameters, "counts_per_motor_rev") *
                                 parameter(parameters, "gear_numerator") /
                                 parameter(parameters, "gear_denominator");
  if (std::isfinite(counts_per_turn) && counts_per_turn > 0)
    radians_per_count = 2 * std::numbers::pi / counts_per_turn;
}

std::string RobotModel::urdf(const std::string& prefix, const std::string& root) const {
  const std::string base = prefix + std::string(kBaseFrame);
  const std::string left = prefix + kLeftWheel, right = prefix + kRightWheel;
  // The axle is above the origin of base_link, which is on the floor between the wheels.
  const std::string body = "<link name=\"" + base + "\"><visual><origin xyz=\"0 0 " +
                           to_text(1.5 * radius_m) + "\"/><geometry><box size=\"" + to_text(separation_m) +
                           " " + to_text(0.8 * separation_m) + " " + to_text(radius_m) +
                           "\"/></geometry></visual></link>";
  return "<?xml version=\"1.0\"?><robot name=\"robot\">" +
         (root.empty() || root == base ? std::string() : footprint_link(root, base)) + body +
         wheel_link(left, radius_m) + wheel_link(right, radius_m) +
         wheel_joint(kLeftJoint, base, left, separation_m / 2, radius_m) +
         wheel_joint(kRightJoint, base, right, -separation_m / 2, radius_m) + "</robot>";
}

msg::Transform RobotModel::wheel(double y_m, double counts) const {
  const double half_rad = counts * radians_per_count / 2;
  return {{0, y_m, radius_m}, {0, std::sin(half_rad), 0, std::cos(half_rad)}};
}

}  // namespace astro::ros2
