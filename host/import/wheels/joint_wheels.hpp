#pragma once

#include <filesystem>
#include <string>

#include "host/import/wheels/joint_names.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// What is wrong with the messages of joints in a bag. Values: the bag, the topic, and both joints.
enum class JointProblem { too_few_messages };

/// What is not given is recognised: the topic if only one has that type, and the wheels by their names.
struct JointSelection {
  std::string topic;
  JointPair joints;
};

/// The wheels in the sensor_msgs/msg/JointState messages of a bag: their positions in radians, made
/// continuous, or the integral of their velocities (trapezoids) if they have no positions. Messages without
/// both joints are skipped, because several drivers may share the topic. Times are header.stamp, and messages
/// without a stamp are left out; but if most messages with these joints have no stamp, the recorder's times
/// are used for all.
///
/// Errors  UnclearChoice if topic or joints are neither given nor recognised, or not in the bag; astro::Error naming the
///         file if it is no bag, or has fewer than two messages of the joints.
WheelTrack wheels_in_bag(const std::filesystem::path& path, const JointSelection& selection = {});

}  // namespace astro::importing
