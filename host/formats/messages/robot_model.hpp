#pragma once

#include <map>
#include <string>

#include "host/formats/messages/geometry.hpp"

namespace astro::ros2 {

/// What a robot looks like to viewers: a base between two wheels, in the sizes that its parameters say. Both its description
/// and the transforms of its wheels come from here, so that they agree.
struct RobotModel {
  double radius_m = 0, separation_m = 0, radians_per_count = 0;

  static constexpr const char* kLeftWheel = "left_wheel";
  static constexpr const char* kRightWheel = "right_wheel";
  static constexpr const char* kLeftJoint = "left_wheel_joint";
  static constexpr const char* kRightJoint = "right_wheel_joint";

  RobotModel() = default;
  /// From the robot's parameters by name. Sizes that are missing or not finite are 0.
  explicit RobotModel(const std::map<std::string, double>& parameters);

  bool complete() const { return radius_m > 0 && separation_m > 0 && radians_per_count > 0; }

  /// URDF. `prefix` is put before the names of all links, as before the frames of transforms. `root`: another link, to which the
  /// base is fixed; "" or the base itself: none. Precondition: complete().
  std::string urdf(const std::string& prefix = {}, const std::string& root = {}) const;

  /// The pose of a wheel that has turned by so many counts, in the base's frame.
  msg::Transform left_wheel(double counts) const { return wheel(separation_m / 2, counts); }
  msg::Transform right_wheel(double counts) const { return wheel(-separation_m / 2, counts); }

 private:
  msg::Transform wheel(double y_m, double counts) const;
};

}  // namespace astro::ros2
