#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>

#include "common/base/result.hpp"
#include "common/protocol/body.hpp"
#include "common/protocol/value_codec.hpp"

/// Encodes messages to bodies and decodes them; everything follows from the schema.
///
/// Cost    encode and decode check the length once, then move words; no table, no branch per integer. Main
///         loop.
namespace astro::protocol {

namespace detail {

/// Calls `f(field)` for each Field of M, or `f(group)` for each Group.
template <bool groups, class M, class F>
constexpr void each(F&& f) {
  const auto one = [&](const auto& field) {
    if constexpr (kIsGroup<std::remove_cvref_t<decltype(field)>> == groups) f(field);
  };
  std::apply([&](const auto&... field) { (one(field), ...); }, M::kFields);
}

template <class Entry>
using WireOf = Wire<typename std::remove_cvref_t<Entry>::Value>;

template <class M>
consteval std::size_t fixed_size() {
  std::size_t size = kHeaderSize;
  each<false, M>([&](const auto& field) { size += WireOf<decltype(field)>::kSize; });
  return size;
}

template <class M>
consteval std::uint32_t group_mask() {
  std::uint32_t mask = 0;
  each<true, M>([&](const auto& group) { mask |= 1U << group.bit; });
  return mask;
}

template <class M>
constexpr bool has(const M& message, unsigned bit) {
  return ((message.fields >> bit) & 1U) != 0;
}

template <class M>
constexpr std::size_t size_of_groups(const M& message) {
  std::size_t size = 0;
  each<true, M>(
      [&](const auto& group) { size += has(message, group.bit) ? WireOf<decltype(group)>::kSize : 0; });
  return size;
}

}  // namespace detail

/// The size of the largest body of M, with its header. All bodies of a message without groups have this size.
template <Message M>
inline constexpr std::size_t kBodySize = kHeaderSize + detail::Wire<M>::kSize;

/// Writes the body of `message` to `out` and returns its size. Cannot fail: every message fits. In `fields` a
/// message with groups may only name groups that it has, because the receiver refuses other bits.
template <Message M>
constexpr std::size_t encode(const M& message, std::uint16_t request_id,
                             std::span<std::uint8_t, kMaxBody> out) {
  static_assert(kBodySize<M> <= kMaxBody);
  std::uint8_t* at = out.data();
  at = detail::Wire<std::uint8_t>::put(at, M::kId);
  at = detail::Wire<std::uint16_t>::put(at, request_id);
  detail::each<false, M>(
      [&](const auto& field) { at = detail::WireOf<decltype(field)>::put(at, message.*field.member); });
  detail::each<true, M>([&](const auto& group) {
    if (detail::has(message, group.bit)) at = detail::WireOf<decltype(group)>::put(at, message.*group.member);
  });
  return static_cast<std::size_t>(at - out.data());
}

/// Reads the body of an M. Groups that are not on the wire keep their default values. Errors: all of
/// DecodeError; the length must be exact.
template <Message M>
constexpr Result<M, DecodeError> decode(std::span<const std::uint8_t> body) {
  constexpr std::size_t kFixed = detail::fixed_size<M>();
  if (body.size() < kHeaderSize) return DecodeError::too_short;
  if (body[0] != M::kId) return DecodeError::wrong_id;
  if (body.size() < kFixed) return DecodeError::too_short;
  M message;
  bool good = true;
  std::size_t size = kFixed;
  const std::uint8_t* at = body.data() + kHeaderSize;
  detail::each<false, M>(
      [&](const auto& field) { at = detail::WireOf<decltype(field)>::get(at, message.*field.member, good); });
  if constexpr (detail::group_mask<M>() != 0) {
    if ((message.fields & ~detail::group_mask<M>()) != 0) return DecodeError::bad_value;
    size += detail::size_of_groups(message);
  }
  if (body.size() != size) return body.size() < size ? DecodeError::too_short : DecodeError::too_long;
  detail::each<true, M>([&](const auto& group) {
    if (detail::has(message, group.bit))
      at = detail::WireOf<decltype(group)>::get(at, message.*group.member, good);
  });
  if (!good) return DecodeError::bad_value;
  return message;
}

}  // namespace astro::protocol
