#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

/// The parts of a message's description. A message is a plain struct with kId, kName, kDoc and kFields, a
/// tuple of Field and Group in wire order. Codec, tests and README.md all follow from that tuple.
namespace astro::protocol {

/// One value. `unit` is unit and scale for people ("1e-6 m/s"), empty where there is none.
template <class M, class T>
struct Field {
  using Value = T;
  T M::*member;
  std::string_view name;
  std::string_view unit;
  std::string_view doc;
};
template <class M, class T>
Field(T M::*, std::string_view, std::string_view, std::string_view) -> Field<M, T>;

/// A record (a struct with kFields of its own) that is on the wire only if `bit` is set in the message's
/// member `fields`, which comes before all groups.
template <class M, class T>
struct Group {
  using Value = T;
  T M::*member;
  unsigned bit;
  std::string_view name;
  std::string_view doc;
};
template <class M, class T>
Group(T M::*, unsigned, std::string_view, std::string_view) -> Group<M, T>;

template <class T>
inline constexpr bool kIsGroup = false;
template <class M, class T>
inline constexpr bool kIsGroup<Group<M, T>> = true;

/// An enumeration whose values count from 0 without gaps and have names: names(E{}) lists them.
template <class E>
concept Named = requires(E value) {
  { names(value) } -> std::convertible_to<std::span<const std::string_view>>;
};

/// False for a value that only another version of the protocol knows.
template <Named E>
constexpr bool known(E value) {
  return static_cast<std::size_t>(value) < names(value).size();
}

/// The value's name; "?" for a value that this version does not know.
template <Named E>
constexpr std::string_view name(E value) {
  return known(value) ? names(value)[static_cast<std::size_t>(value)] : "?";
}

template <class T>
concept Message = requires {
  { T::kId } -> std::convertible_to<std::uint8_t>;
  { T::kName } -> std::convertible_to<std::string_view>;
  { T::kDoc } -> std::convertible_to<std::string_view>;
  T::kFields;
};

/// A request names its reply: one of its own, or Ack. An ErrorReply can always come instead.
template <class T>
concept Request = Message<T> && requires {
  typename T::Reply;
};

}  // namespace astro::protocol
