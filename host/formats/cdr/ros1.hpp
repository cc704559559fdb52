#pragma once

#include <optional>

#include "host/formats/cdr/message_layout.hpp"

namespace astro::ros2 {

/// The CDR of a message that ROS 1 serialised: its numbers are little-endian and packed, strings have no NUL,
/// and a header begins with a sequence number, which is dropped. Nothing if the bytes are not exactly one
/// message of this layout, or if they would become eight times as many, as only messages of thousands of
/// empty messages do.
std::optional<Bytes> cdr_from_ros1(const MessageLayout& layout, ByteView message);

}  // namespace astro::ros2
