#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/formats/cdr/type_description.hpp"

/// How the messages of a type that this program does not know are laid out, from the definition that a
/// recording carries.
namespace astro::ros2 {

/// The fields of a message and of all messages that it contains, in the order of their bytes in CDR.
struct MessageLayout {
  /// What is more than its fields: a time is one value, and in ROS 1 a header has a sequence number before
  /// its fields.
  enum class Role : std::uint8_t { plain, time, header };
  struct Field {
    std::string name;
    TypeId id = kNested;  // of one element; kString also for bounded strings
    Shape shape = Shape::single;
    std::size_t capacity = 0;  // of an array
    std::size_t type = 0;      // the index of a nested message in `types`
    bool operator==(const Field&) const = default;
  };
  struct Type {
    std::string name;  // "geometry_msgs/msg/Pose"
    Role role = Role::plain;
    std::vector<Field> fields;
    bool operator==(const Type&) const = default;
  };

  std::vector<Type> types;  // the first one is the message
  bool operator==(const MessageLayout&) const = default;
};

/// The languages in which recordings have definitions: .msg files of ROS 1 and of ROS 2, one behind the other
/// with rules of '=' between them. Rejected: IDL, which only recordings of types that were written as IDL
/// have.
enum class DefinitionFormat : std::uint8_t { ros1msg, ros2msg };

/// Parses the definition of the type `name`, in which a std_msgs/Header and times need not be defined.
/// Constants, defaults and comments are skipped. The layout is that of CDR in both formats: a header has no
/// sequence number.
///
/// Nothing if a line is no field, if two fields have one name, if a message is not defined or contains
/// itself, if messages nest deeper than 32 levels, if there are more than 20,000 fields, for a wstring, or
/// for an empty text of ROS 2, where it means that nothing is known.
std::optional<MessageLayout> parse_definition(std::string_view name, std::string_view text,
                                              DefinitionFormat format);

/// "nav_msgs/msg/Odometry" for ROS 1's "nav_msgs/Odometry". The type of ROS 1's first transforms,
/// tf/tfMessage, becomes tf2_msgs/msg/TFMessage, which has the same fields.
std::string ros2_type_name(std::string_view ros1_name);

/// The bytes of a number; 0 for strings and nested messages.
std::size_t bytes_of(TypeId id);

}  // namespace astro::ros2
