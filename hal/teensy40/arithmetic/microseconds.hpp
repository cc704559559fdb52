#pragma once

#include <cstdint>

namespace astro::teensy40 {

/// Counts of the 24 MHz crystal as whole microseconds: exactly count / 24, for every count.
///
/// Cost    about 15 instructions; the library's 64-bit division takes 60 and more.
constexpr std::uint64_t microseconds(std::uint64_t count_24MHz) {
  // count / 24 = (count / 8) / 3, and 2^32 = 3 * 0x55555555 + 1 carries the upper word's remainder down.
  const std::uint64_t eighths = count_24MHz >> 3;
  const auto upper = static_cast<std::uint32_t>(eighths >> 32), lower = static_cast<std::uint32_t>(eighths);
  const std::uint32_t carry = upper % 3;
  return (std::uint64_t{upper / 3} << 32) + std::uint64_t{carry * 0x5555'5555U} + lower / 3 +
         (carry + lower % 3) / 3;
}

}  // namespace astro::teensy40
