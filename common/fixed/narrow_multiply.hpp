#pragma once

#include <cstdint>

/// Wide products for processors whose multiplier gives only the low 32 bits of a product, as the Cortex-M0+: its compiler
/// calls a library function for each of them, which takes three times as long. The same values as multiply.hpp.
namespace astro::narrow {

/// a * b, exactly, as a sum of four products of 16-bit halves:
///
///   a * b = (aH * bH) * 2^32 + (aH * bL + aL * bH) * 2^16 + aL * bL      upper halves signed, lower ones not
///
/// The carries are added to the middle products one after the other, because neither sum then exceeds 32 bits: the
/// largest is 0x7FFF * 0xFFFF + 0xFFFF. The low word is one product more, which costs less than putting it together.
///
/// Cost    some 20 instructions on the Cortex-M0+; callable from the control tick.
constexpr std::int64_t mul_wide(std::int32_t a, std::int32_t b) {
  const std::uint32_t a_low = static_cast<std::uint32_t>(a) & 0xFFFF;
  const std::uint32_t b_low = static_cast<std::uint32_t>(b) & 0xFFFF;
  const std::int32_t a_high = a >> 16, b_high = b >> 16;
  const std::uint32_t lowest = a_low * b_low;
  const std::int32_t middle =
      a_high * static_cast<std::int32_t>(b_low) + static_cast<std::int32_t>(lowest >> 16);
  const std::int32_t other = static_cast<std::int32_t>(a_low) * b_high +
                             static_cast<std::int32_t>(static_cast<std::uint32_t>(middle) & 0xFFFF);
  const std::int32_t high = a_high * b_high + (middle >> 16) + (other >> 16);
  const std::uint32_t low = static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b);
  return static_cast<std::int64_t>(std::uint64_t{static_cast<std::uint32_t>(high)} << 32 | low);
}

/// The low 64 bits of a * b: the whole product of the lower word, which counts as signed here, and the low half of the
/// upper word's product.
constexpr std::int64_t mul_low(std::int64_t a, std::int32_t b) {
  const auto low = static_cast<std::int32_t>(static_cast<std::uint32_t>(a));
  const std::uint32_t high = static_cast<std::uint32_t>(a >> 32) + (static_cast<std::uint32_t>(a) >> 31);
  const auto product = static_cast<std::uint64_t>(mul_wide(low, b));
  return static_cast<std::int64_t>(product + (std::uint64_t{high * static_cast<std::uint32_t>(b)} << 32));
}

}  // namespace astro::narrow
