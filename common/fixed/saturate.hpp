#pragma once

#include <cstdint>
#include <type_traits>

#include "common/fixed/multiply.hpp"

namespace astro {

constexpr std::int32_t saturate32(std::int64_t value) {
  if (value > INT32_MAX) return INT32_MAX;
  if (value < INT32_MIN) return INT32_MIN;
  return static_cast<std::int32_t>(value);
}

/// a + b and a - b, limited to 32 bits: one instruction on the Cortex-M7.
constexpr std::int32_t add_saturated(std::int32_t a, std::int32_t b) {
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    std::int32_t sum = 0;
    asm("qadd %0, %1, %2" : "=r"(sum) : "r"(a), "r"(b));
    return sum;
  }
#endif
  return saturate32(std::int64_t{a} + b);
}

constexpr std::int32_t subtract_saturated(std::int32_t a, std::int32_t b) {
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    std::int32_t difference = 0;
    asm("qsub %0, %1, %2" : "=r"(difference) : "r"(a), "r"(b));
    return difference;
  }
#endif
  return saturate32(std::int64_t{a} - b);
}

constexpr std::int64_t magnitude(std::int64_t value) { return value < 0 ? -value : value; }

/// |value| > limit, for limit >= 0: one comparison.
constexpr bool exceeds(std::int32_t value, std::int32_t limit) {
  return static_cast<std::uint32_t>(value) + static_cast<std::uint32_t>(limit) >
         2 * static_cast<std::uint32_t>(limit);
}

/// `value` * 2^Shift, which must fit into 32 bits, limited to the range of a signed integer of `Bits` bits:
/// one instruction on the Cortex-M7.
template <int Bits, int Shift = 0>
constexpr std::int32_t saturate_to(std::int32_t value) {
  static_assert(Bits >= 2 && Bits <= 32 && Shift >= 0 && Shift < 32);
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    std::int32_t held = 0;
    asm("ssat %0, %2, %1, lsl %3" : "=r"(held) : "r"(value), "I"(Bits), "I"(Shift));
    return held;
  }
#endif
  const auto shifted = static_cast<std::int32_t>(static_cast<std::uint32_t>(value) << Shift);
  constexpr auto kMost = static_cast<std::int32_t>((std::int64_t{1} << (Bits - 1)) - 1);
  return shifted > kMost ? kMost : shifted < -kMost - 1 ? -kMost - 1 : shifted;
}

/// `value` limited to [-limit, limit]; limit >= 0.
template <class Int>
constexpr Int clamp_abs(Int value, Int limit) {
  if (value > limit) return limit;
  if (value < -limit) return -limit;
  return value;
}

}  // namespace astro
