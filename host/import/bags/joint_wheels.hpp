#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/import/wheels/joint_names.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// What is wrong with the messages of joints in a bag. Values: the bag, the topic, and both joints.
enum class JointProblem { too_few_messages };

/// Joints that are not given are recognised by their names.
struct JointSelection {
  std::string topic;
  JointPair joints = {};
  /// Further wheels on the same sides: a side's travel is the mean of its wheels.
  std::vector<JointPair> further = {};
};

/// The wheels in the sensor_msgs/msg/JointState messages of a topic of a bag: their positions in radians,
/// made continuous, or the integral of their velocities (speed_integral.hpp) if they have no positions.
/// Messages without all joints are skipped, because several drivers may share the topic. Times are
/// header.stamp, and messages without a stamp are left out; but if most messages with these joints have no
/// stamp, the recorder's times are used for all. If a side has several wheels, a remark says by how much
/// their travel differs.
///
/// Errors  UnclearChoice if joints are neither given nor recognised, or not in the bag; astro::Error naming the
///         file if it is no bag, or has fewer than two messages of the joints.
WheelTrack wheels_of_joints(const std::filesystem::path& path, const JointSelection& selection);

}  // namespace astro::importing
