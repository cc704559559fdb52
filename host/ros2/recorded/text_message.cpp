#include "host/ros2/recorded/text_message.hpp"

#include "host/ros2/cdr/codec.hpp"
#include "host/ros2/messages/std.hpp"

namespace astro::ros2 {
const RosType& string_type() {
  static const RosType type = ros_type<msg::String>();
  return type;
}

Bytes encode_text(std::string_view text) { return encode(msg::String{std::string(text)}); }

std::optional<std::string> decode_text(ByteView bytes) {
  auto message = decode<msg::String>(bytes);
  if (!message) return std::nullopt;
  return std::move(message->data);
}

}  // namespace astro::ros2
