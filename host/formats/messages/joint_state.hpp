#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/formats/messages/ros_messages.hpp"

namespace astro::ros2 {

/// sensor_msgs/msg/JointState: what a robot's joints do at one instant. Each of the three lists is as long as
/// `names`, or empty if the robot does not say it.
struct JointState {
  std::int64_t time_ns = 0;  // header.stamp
  std::vector<std::string> names;
  std::vector<double> positions, velocities, efforts;  // rad or m, and per second

  bool operator==(const JointState&) const = default;
};

/// More joints than any robot has. A short name takes eight times its bytes in memory, so a message is not allowed
/// to hold any number of them.
inline constexpr std::size_t kMostJoints = 4096;

const RosType& joint_state_type();

/// Precondition: a time within 2^31 s.
Bytes encode_joint_state(const JointState& state);

/// Nothing if the message is too short for its type, has more than kMostJoints, a name longer than kLongestName
/// (cdr.hpp), or a list of another length.
std::optional<JointState> decode_joint_state(ByteView message);

}  // namespace astro::ros2
