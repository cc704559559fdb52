#pragma once

#include <filesystem>
#include <string>

#include "host/import/wheels/joint_names.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// What is not given is recognised: the only topic of that type, and the names of the wheels.
struct JointSelection {
  std::string topic;
  JointPair joints;
};

/// The wheels in the sensor_msgs/msg/JointState messages of a bag: their positions in radians, made continuous; the
/// integral of their velocities (trapezoids) if they have no positions. Messages without both joints are passed over,
/// because several drivers may share the topic. Times are header.stamp, and messages without one are left
/// out, or those of the recorder if most messages with these joints have none.
///
/// Errors  UnclearChoice if topic or joints are neither given nor recognised, or not in the bag; astro::Error naming the
///         file if it is no bag, or has fewer than two messages of the joints.
WheelTrack wheels_in_bag(const std::filesystem::path& path, const JointSelection& selection = {});

}  // namespace astro::importing
