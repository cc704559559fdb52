#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/formats/cdr/message.hpp"

/// Describes a message type as ROS 2 does, from its list of fields. The type's definition as text follows from that, and
/// its hash (type_hash.hpp).
namespace astro::ros2 {

/// As type_description_interfaces/msg/FieldType numbers them.
enum TypeId : std::uint8_t {
  kNested = 1,
  kInt8 = 2,
  kUint8 = 3,
  kInt16 = 4,
  kUint16 = 5,
  kInt32 = 6,
  kUint32 = 7,
  kInt64 = 8,
  kUint64 = 9,
  kFloat32 = 10,
  kFloat64 = 11,
  kBool = 15,
  kByte = 16,
  kString = 17,
  kBoundedString = 21
};

enum class Shape : std::uint8_t { single = 0, array = 48, bounded_sequence = 96, sequence = 144 };

struct FieldType {
  TypeId id = kNested;  // of one element
  Shape shape = Shape::single;
  std::size_t capacity = 0;         // of an array or a bounded sequence, in elements
  std::size_t string_capacity = 0;  // of a bounded string
  std::string nested{};             // its type's name, "" if it is no message
};

struct TypeDescription {
  std::string name;  // "nav_msgs/msg/Odometry"
  struct Named {
    std::string name;
    FieldType type;
  };
  std::vector<Named> fields;
  /// All messages that it contains, directly or nested, by name. Their own `referred` is empty.
  std::map<std::string, TypeDescription> referred;
};

template <Message M>
TypeDescription describe();

template <class T>
FieldType single_type() {
  if constexpr (Message<T>)
    return {kNested, Shape::single, 0, 0, std::string(T::kType)};
  else if constexpr (std::is_same_v<T, bool>)
    return {kBool};
  else if constexpr (std::is_same_v<T, std::byte>)
    return {kByte};
  else if constexpr (std::is_same_v<T, std::string>)
    return {kString};
  else if constexpr (IsBoundedText<T>::value)
    return {kBoundedString, Shape::single, 0, IsBoundedText<T>::kMost, ""};
  else if constexpr (std::is_floating_point_v<T>)
    return {sizeof(T) == 4 ? kFloat32 : kFloat64};
  else  // signed and unsigned take turns as the sizes grow
    return {static_cast<TypeId>(2 * std::bit_width(sizeof(T)) + (std::is_unsigned_v<T> ? 1 : 0))};
}

template <class T>
FieldType field_type() {
  if constexpr (IsArray<T>::value || IsSequence<T>::value || IsOptional<T>::value) {
    FieldType type = single_type<typename T::value_type>();
    type.shape = IsArray<T>::value      ? Shape::array
                 : IsOptional<T>::value ? Shape::bounded_sequence
                                        : Shape::sequence;
    if constexpr (IsArray<T>::value) type.capacity = std::tuple_size_v<T>;
    if constexpr (IsOptional<T>::value) type.capacity = 1;
    return type;
  } else {
    return single_type<T>();
  }
}

template <class T>
void refer_to(std::map<std::string, TypeDescription>& all) {
  if constexpr (IsArray<T>::value || IsSequence<T>::value || IsOptional<T>::value) {
    refer_to<typename T::value_type>(all);
  } else if constexpr (Message<T>) {
    TypeDescription described = describe<T>();
    all.merge(std::exchange(described.referred, {}));
    all.emplace(described.name, std::move(described));
  }
}

template <Message M>
TypeDescription describe() {
  TypeDescription description{std::string(M::kType), {}, {}};
  M message{};
  for_each_field(message, [&]<class T>(std::string_view name, const T&) {
    description.fields.push_back({std::string(name), field_type<T>()});
    refer_to<T>(description.referred);
  });
  // IDL has no empty structs.
  if (description.fields.empty())
    description.fields.push_back({"structure_needs_at_least_one_member", {kUint8}});
  return description;
}

/// The definition as text (ros2msg): the fields, then those of each referred message behind a rule and its name.
std::string definition_in_words(const TypeDescription& description);

template <Message M>
const std::string& definition_of() {
  static const std::string definition = definition_in_words(describe<M>());
  return definition;
}

/// The name of a message type on the wire: "nav_msgs::msg::dds_::Odometry_" for "nav_msgs/msg/Odometry".
std::string dds_type_name(std::string_view type);

/// The reverse of dds_type_name(); nothing if it is no message type of ROS 2. The name may come from anybody.
std::optional<std::string> ros_type_name(std::string_view dds_name);

}  // namespace astro::ros2
