#include "host/ros2/text_message.hpp"

#include "host/ros2/cdr.hpp"

namespace astro::ros2 {
namespace {

constexpr RosType kStringType{"std_msgs/msg/String", "string data\n"};

}  // namespace

const RosType& string_type() { return kStringType; }

Bytes encode_text(std::string_view text) {
  CdrWriter out;
  out.string(text);
  return out.bytes();
}

std::optional<std::string> decode_text(ByteView message) {
  CdrReader in(message);
  const std::string_view text = in.string();
  if (!in.ok()) return std::nullopt;
  return std::string(text);
}

}  // namespace astro::ros2
