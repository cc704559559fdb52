#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>

/// The host's files and links have host/base/bytes.hpp, which also knows signed numbers and floats.
namespace astro {

/// Writes `value` to the sizeof(T) bytes from `to` on, the least significant byte first.
///
/// Cost  one word move: the bytes are listed one by one because the compiler merges them then, which it does
/// not do for a loop.
template <std::unsigned_integral T>
constexpr void store_little_endian(std::uint8_t* to, T value) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((to[I] = static_cast<std::uint8_t>(value >> (8 * I))), ...);
  }
  (std::make_index_sequence<sizeof(T)>{});
}

/// The number in the sizeof(T) bytes from `from` on.
template <std::unsigned_integral T>
constexpr T load_little_endian(const std::uint8_t* from) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return static_cast<T>(((static_cast<T>(from[I]) << (8 * I)) | ...));
  }
  (std::make_index_sequence<sizeof(T)>{});
}

static_assert(load_little_endian<std::uint32_t>(std::array<std::uint8_t, 4>{1, 2, 3, 4}.data()) ==
              0x0403'0201);

}  // namespace astro
