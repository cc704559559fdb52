#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace astro {

namespace detail {
constexpr std::array<std::uint32_t, 256> crc32_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t remainder = byte;
    for (int i = 0; i < 8; ++i) remainder = (remainder >> 1) ^ ((remainder & 1U) != 0 ? 0xEDB88320U : 0U);
    table[byte] = remainder;
  }
  return table;
}
inline constexpr auto kCrc32Table = crc32_table();
}  // namespace detail

/// CRC-32 as in IEEE 802.3 and zlib: polynomial 0x04C11DB7 reflected, register preset to ones, result
/// inverted. Incremental: crc32(ab) == crc32(b, crc32(a)), and the crc of nothing is 0.
///
/// Cost    one table look-up per byte, 1 KB of constants. Source: check value 0xCBF43926 for "123456789" in
///         Williams, "A Painless Guide to CRC Error Detection Algorithms", and the catalogue of parametrised
///         CRCs.
constexpr std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before = 0) {
  std::uint32_t crc = ~before;
  for (const std::uint8_t byte : bytes) crc = (crc >> 8) ^ detail::kCrc32Table[(crc ^ byte) & 0xFFU];
  return ~crc;
}

}  // namespace astro
