#include "host/formats/cdr/type_description.hpp"

#include <fmt/format.h>

#include <array>

namespace astro::ros2 {
namespace {

constexpr std::string_view kRule =
    "================================================================================\n";

/// "geometry_msgs/Pose" for "geometry_msgs/msg/Pose", as definitions write it.
std::string short_name(const std::string& type) {
  return type.substr(0, type.find('/')) + type.substr(type.rfind('/'));
}

std::string word(const FieldType& type) {
  constexpr std::array kNumbers{"int8",   "uint8", "int16",  "uint16",  "int32",
                                "uint32", "int64", "uint64", "float32", "float64"};
  switch (type.id) {
    case kNested:
      return short_name(type.nested);
    case kBool:
      return "bool";
    case kByte:
      return "byte";
    case kString:
      return "string";
    case kBoundedString:
      return fmt::format("string<={}", type.string_capacity);
    default:
      return kNumbers[type.id - kInt8];
  }
}

std::string brackets(const FieldType& type) {
  switch (type.shape) {
    case Shape::single:
      return "";
    case Shape::array:
      return fmt::format("[{}]", type.capacity);
    case Shape::bounded_sequence:
      return fmt::format("[<={}]", type.capacity);
    case Shape::sequence:
      return "[]";
  }
  return "";
}

std::string lines(const TypeDescription& description) {
  std::string text;
  for (const auto& [name, type] : description.fields)
    text += fmt::format("{}{} {}\n", word(type), brackets(type), name);
  return text;
}

}  // namespace

std::string definition_in_words(const TypeDescription& description) {
  std::string text = lines(description);
  for (const auto& [name, referred] : description.referred)
    text += fmt::format("{}MSG: {}\n{}", kRule, short_name(name), lines(referred));
  return text;
}

std::string dds_type_name(std::string_view type) {
  std::string name;
  for (const char c : type) name += c == '/' ? "::" : std::string(1, c);
  return name.insert(name.rfind("::") + 2, "dds_::") + '_';
}

std::optional<std::string> ros_type_name(std::string_view dds_name) {
  constexpr std::string_view kMiddle = "::msg::dds_::";
  const std::size_t middle = dds_name.find(kMiddle);
  if (middle == 0 || middle == std::string_view::npos || !dds_name.ends_with('_')) return std::nullopt;
  const std::string_view package = dds_name.substr(0, middle);
  dds_name.remove_prefix(middle + kMiddle.size());
  if (dds_name.size() < 2) return std::nullopt;
  dds_name.remove_suffix(1);
  return fmt::format("{}/msg/{}", package, dds_name);
}

}  // namespace astro::ros2
