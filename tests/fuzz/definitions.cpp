// Definitions of messages, and messages by them. A zero ends the definition, the rest is the message.
#include <algorithm>
#include <string>

#include "host/formats/cdr/field_reader.hpp"
#include "host/formats/cdr/message_layout.hpp"
#include "host/formats/cdr/ros1.hpp"
#include "host/formats/messages/geometry.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/ros1/ros1_bag.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  const auto zero = std::find(input.begin(), input.end(), 0);
  const auto length = static_cast<std::size_t>(zero - input.begin());
  const std::string text(input.begin(), zero);
  const ByteView message = input.subspan(std::min(length + 1, input.size()));
  for (const auto format : {ros2::DefinitionFormat::ros1msg, ros2::DefinitionFormat::ros2msg}) {
    const auto layout = ros2::parse_definition("p/T", text, format);
    if (!layout) continue;
    const auto converted = ros2::cdr_from_ros1(*layout, message);
    require(!converted || converted->size() <= 200 + 16 * message.size(),
            "a message grows by a factor at most");
    std::vector<std::string> paths;
    for (const ros2::NumberField& field : ros2::number_fields(*layout))
      if (paths.size() < 60) paths.push_back(field.path);
    if (const std::string stamp = ros2::stamp_field(*layout); !stamp.empty()) paths.push_back(stamp);
    auto reader = ros2::FieldReader::of(*layout, paths);
    require(reader.has_value(), "every number that is listed can be read");
    reader->read(message);
    if (converted) require(reader->read(*converted) != nullptr, "what was converted fits its layout");
    ros2::FieldReader::of(*layout, {text});
  }
}

std::vector<Bytes> seeds() {
  const auto seed = [](const std::string& definition, const Bytes& message) {
    Bytes bytes(definition.begin(), definition.end());
    bytes.push_back(0);
    bytes.insert(bytes.end(), message.begin(), message.end());
    return bytes;
  };
  return {seed(support::ros1::kOdometry, support::Ros1Message::encode(ros2::msg::Odometry{})),
          seed(support::ros1::kTf, support::Ros1Message::encode(ros2::msg::TFMessage{{{}, {}}})),
          seed("int32<=3[<=2] a\nuint8 X=1\nstring<=4[3] b \"x\"\nT c\nEmpty[] d\n" + support::ros1::kRule +
                   "\nMSG: p/Empty\n",
               Bytes(20))};
}

}  // namespace astro::fuzz
