#pragma once

#include <optional>
#include <string>

#include "host/base/bytes.hpp"
#include "host/formats/messages/ros_messages.hpp"

/// std_msgs/msg/String, the type in which a robot's description (URDF) is published.
namespace astro::ros2 {

const RosType& string_type();

Bytes encode_text(std::string_view text);
/// Nothing if the message is too short for its type.
std::optional<std::string> decode_text(ByteView message);

}  // namespace astro::ros2
