#include "host/formats/messages/text_message.hpp"

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/std.hpp"

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
