#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "common/base/little_endian.hpp"
#include "common/base/text.hpp"
#include "common/protocol/field.hpp"

/// How each supported type is encoded: little-endian, packed. `put` and `get` move one value and return the
/// position after it. They do not check for room; the message codec has done that for the whole message.
namespace astro::protocol::detail {

template <class T>
concept WireInteger = std::integral<T> && !std::same_as<T, bool> && !std::same_as<T, char>;
template <class T>
concept WireEnum = std::is_enum_v<T> && Named<T>;
template <class T>
concept Record = requires {
  T::kFields;
};

template <class T>
struct Wire;

template <WireInteger T>
struct Wire<T> {
  static constexpr std::size_t kSize = sizeof(T);
  using Bits = std::make_unsigned_t<T>;

  static constexpr std::uint8_t* put(std::uint8_t* at, T value) {
    store_little_endian(at, static_cast<Bits>(value));
    return at + kSize;
  }
  static constexpr const std::uint8_t* get(const std::uint8_t* at, T& value, bool&) {
    value = static_cast<T>(load_little_endian<Bits>(at));
    return at + kSize;
  }
};

template <WireEnum E>
struct Wire<E> {
  using Base = std::underlying_type_t<E>;
  static constexpr std::size_t kSize = sizeof(E);
  static constexpr std::uint8_t* put(std::uint8_t* at, E value) {
    return Wire<Base>::put(at, static_cast<Base>(value));
  }
  static constexpr const std::uint8_t* get(const std::uint8_t* at, E& value, bool& good) {
    Base base{};
    at = Wire<Base>::get(at, base, good);
    value = static_cast<E>(base);
    good = good && known(value);
    return at;
  }
};

template <std::size_t N>
struct Wire<std::array<std::uint8_t, N>> {
  static constexpr std::size_t kSize = N;
  static constexpr std::uint8_t* put(std::uint8_t* at, const std::array<std::uint8_t, N>& bytes) {
    return std::copy(bytes.begin(), bytes.end(), at);
  }
  static constexpr const std::uint8_t* get(const std::uint8_t* at, std::array<std::uint8_t, N>& bytes,
                                           bool&) {
    std::copy_n(at, N, bytes.begin());
    return at + N;
  }
};

template <std::size_t N>
struct Wire<Text<N>> {
  static constexpr std::size_t kSize = N;
  static constexpr std::uint8_t* put(std::uint8_t* at, const Text<N>& text) {
    return std::copy(text.characters().begin(), text.characters().end(), at);
  }
  // Refuses other bytes after the first NUL, so that equal texts have equal bytes on the wire, too.
  static constexpr const std::uint8_t* get(const std::uint8_t* at, Text<N>& text, bool& good) {
    std::array<char, N> characters{};
    std::copy_n(at, N, characters.begin());
    text = Text<N>(std::string_view(characters.data(), N));
    good = good && text.characters() == characters;
    return at + N;
  }
};

template <Record T>
struct Wire<T> {
  static constexpr std::size_t kSize = std::apply(
      [](const auto&... field) {
        return (std::size_t{0} + ... + Wire<typename std::remove_cvref_t<decltype(field)>::Value>::kSize);
      },
      T::kFields);
  static constexpr std::uint8_t* put(std::uint8_t* at, const T& record) {
    const auto one = [&](const auto& field) {
      using Value = typename std::remove_cvref_t<decltype(field)>::Value;
      at = Wire<Value>::put(at, record.*field.member);
    };
    std::apply([&](const auto&... field) { (one(field), ...); }, T::kFields);
    return at;
  }
  static constexpr const std::uint8_t* get(const std::uint8_t* at, T& record, bool& good) {
    const auto one = [&](const auto& field) {
      using Value = typename std::remove_cvref_t<decltype(field)>::Value;
      at = Wire<Value>::get(at, record.*field.member, good);
    };
    std::apply([&](const auto&... field) { (one(field), ...); }, T::kFields);
    return at;
  }
};

}  // namespace astro::protocol::detail
