#include "host/formats/messages/known_layouts.hpp"

#include <algorithm>
#include <string>

namespace astro::ros2 {
namespace {

struct KnownType {
  std::string_view name, definition;
};

constexpr KnownType kKnownTypes[] = {
    {"std_msgs/msg/Int8", "int8 data"},
    {"std_msgs/msg/Int16", "int16 data"},
    {"std_msgs/msg/Int32", "int32 data"},
    {"std_msgs/msg/Int64", "int64 data"},
    {"std_msgs/msg/UInt8", "uint8 data"},
    {"std_msgs/msg/UInt16", "uint16 data"},
    {"std_msgs/msg/UInt32", "uint32 data"},
    {"std_msgs/msg/UInt64", "uint64 data"},
    {"std_msgs/msg/Float32", "float32 data"},
    {"std_msgs/msg/Float64", "float64 data"},
    {"turtlebot3_msgs/msg/SensorState",
     "std_msgs/Header header\nuint8 bumper\nfloat32 cliff\nfloat32 sonar\nfloat32 illumination\nuint8 led\n"
     "uint8 button\nbool torque\nint32 left_encoder\nint32 right_encoder\nfloat32 battery\n"},
    {"irobot_create_msgs/msg/WheelTicks", "std_msgs/Header header\nint32 ticks_left\nint32 ticks_right\n"}};

}  // namespace

std::shared_ptr<const MessageLayout> known_layout(std::string_view type) {
  const auto* known = std::ranges::find(kKnownTypes, type, &KnownType::name);
  if (known == std::end(kKnownTypes)) return nullptr;
  auto layout = parse_definition(known->name, known->definition, DefinitionFormat::ros2msg);
  return layout ? std::make_shared<const MessageLayout>(std::move(*layout)) : nullptr;
}

}  // namespace astro::ros2
