#pragma once

#include <rapidcheck.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "common/protocol/codec.hpp"

/// Arbitrary messages for property tests, drawn field by field from the schema. Only within a running
/// property.
namespace astro::protocol {

template <std::integral T>
void draw(T& value) {
  value = *rc::gen::arbitrary<T>();
}

template <Named E>
void draw(E& value) {
  value = static_cast<E>(*rc::gen::inRange<std::size_t>(0, names(E{}).size()));
}

template <std::size_t N>
void draw(std::array<std::uint8_t, N>& bytes) {
  bytes = *rc::gen::container<std::array<std::uint8_t, N>>(rc::gen::arbitrary<std::uint8_t>());
}

template <std::size_t N>
void draw(Text<N>& text) {
  text = Text<N>(*rc::gen::resize(static_cast<int>(2 * N), rc::gen::string<std::string>()));
}

template <detail::Record T>
void draw(T& record) {
  detail::each<false, T>([&](const auto& field) { draw(record.*field.member); });
  if constexpr (requires { record.fields; } && detail::group_mask<T>() != 0) {
    record.fields &= detail::group_mask<T>();
  }
  detail::each<true, T>([&](const auto& group) {
    if (detail::has(record, group.bit)) draw(record.*group.member);
  });
}

template <Message M>
M arbitrary() {
  M message;
  draw(message);
  return message;
}

}  // namespace astro::protocol
