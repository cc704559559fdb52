#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/little_endian.hpp"

namespace astro {

namespace detail {

/// Table k holds the remainder of each byte followed by k zero bytes.
template <std::size_t Slices>
consteval std::array<std::array<std::uint32_t, 256>, Slices> crc32_tables() {
  std::array<std::array<std::uint32_t, 256>, Slices> tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (std::size_t bit = 0; bit < Slices * 8; ++bit) {
      remainder = (remainder >> 1) ^ ((remainder & 1U) != 0 ? 0xEDB88320U : 0U);
      if (bit % 8 == 7) tables[bit / 8][byte] = remainder;
    }
  }
  return tables;
}
template <std::size_t Slices>
inline constexpr auto kCrc32Tables = crc32_tables<Slices>();

#if defined(__arm__)
inline constexpr std::size_t kCrc32Slices = 1;  // 1 KB of constants, because flash is scarcer than time
#else
inline constexpr std::size_t kCrc32Slices = 4;  // 4 KB: 1 ns per byte, a quarter of the time with one table
#endif

}  // namespace detail

/// CRC-32 as in IEEE 802.3, zlib and PNG ("CRC-32/ISO-HDLC"): polynomial 0x04C11DB7 reflected, register
/// preset to ones, result inverted. Incremental: crc32(ab) == crc32(b, crc32(a)); the CRC of no bytes is 0.
/// Detects every burst of up to 32 bits. The value does not depend on the number of slices.
///
/// Cost    one step for `Slices` bytes, with independent table look-ups; 1 KB of constants for each slice.
/// Source  "slicing by 4", Kounavis and Berry, IEEE ISCC 2005.
template <std::size_t Slices = detail::kCrc32Slices>
constexpr std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before = 0) {
  static_assert(Slices == 1 || Slices == 4);
  const auto& table = detail::kCrc32Tables<Slices>;
  std::uint32_t crc = ~before;
  if constexpr (Slices == 4) {
    while (bytes.size() >= 4) {
      crc ^= load_little_endian<std::uint32_t>(bytes.data());
      crc = table[3][crc & 0xFFU] ^ table[2][(crc >> 8) & 0xFFU] ^ table[1][(crc >> 16) & 0xFFU] ^
            table[0][crc >> 24];
      bytes = bytes.subspan(4);
    }
  }
  for (const std::uint8_t byte : bytes) crc = (crc >> 8) ^ table[0][(crc ^ byte) & 0xFFU];
  return ~crc;
}

}  // namespace astro
