#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "host/base/bytes.hpp"

/// A ROS 2 message as a struct that says its name and lists its fields: from that list follow its bytes (codec.hpp), its
/// definition as text and the hash of its type (type_description.hpp).
///
///     struct Point {
///       double x = 0, y = 0, z = 0;
///       static constexpr std::string_view kType = "geometry_msgs/msg/Point";
///       static constexpr std::tuple kFields{Field{&Point::x, "x"}, Field{&Point::y, "y"}, Field{&Point::z, "z"}};
///       bool operator==(const Point&) const = default;
///     };
///
/// A field is a bool, a number, a std::byte (ROS's byte), a std::string or a BoundedText, a message, a std::array of one of
/// these (fixed length), a std::vector (any length) or a std::optional (at most one).
namespace astro::ros2 {

template <class Struct, class Type>
struct Field {
  Type Struct::*member;
  std::string_view name;
};
template <class Struct, class Type>  // clang 14 does not deduce it from an aggregate
Field(Type Struct::*, std::string_view)->Field<Struct, Type>;

template <class T>
concept Message = requires {
  T::kType;
  T::kFields;
};

/// string<=N. A message with a longer text is refused.
template <std::size_t N>
struct BoundedText {
  std::string text;

  bool operator==(const BoundedText&) const = default;
};

template <Message M>
inline constexpr bool kIsEmpty = std::tuple_size_v<std::remove_cvref_t<decltype(M::kFields)>> == 0;

/// Calls `visit(name, field)` for each field in order. `M` may be const.
template <class M, class Visit>
void for_each_field(M& message, Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field.name, message.*field.member), ...); },
             std::remove_const_t<M>::kFields);
}

template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};

template <class T>
struct IsSequence : std::false_type {};
template <class T>
struct IsSequence<std::vector<T>> : std::true_type {};

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

template <class T>
struct IsBoundedText : std::false_type {};
template <std::size_t N>
struct IsBoundedText<BoundedText<N>> : std::true_type {
  static constexpr std::size_t kMost = N;
};

}  // namespace astro::ros2
