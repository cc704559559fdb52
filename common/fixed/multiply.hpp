#pragma once

#include <cstdint>
#include <type_traits>

#include "common/fixed/narrow_multiply.hpp"

/// 32-bit products in one instruction each. The compiler for the Cortex-M7 turns a widened product that is
/// used twice into a 64 x 64 bit product of six instructions; inline assembly keeps it at one. The Cortex-M0+
/// has no wide product at all and makes it of four narrow ones. Other processors, and the compiler, compute
/// the same value in plain C++ (tests/target shows that all are equal).
namespace astro {

#if defined(__ARM_FEATURE_DSP)
#define ASTRO_ON_CORTEX_M7 1
#else
#define ASTRO_ON_CORTEX_M7 0
#endif
#if defined(__ARM_ARCH_6M__)
#define ASTRO_ON_CORTEX_M0 1
#else
#define ASTRO_ON_CORTEX_M0 0
#endif

/// a * b, exactly.
constexpr std::int64_t mul_wide(std::int32_t a, std::int32_t b) {
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    std::int64_t product = 0;
    asm("smull %Q0, %R0, %1, %2" : "=&r"(product) : "r"(a), "r"(b));
    return product;
  }
#endif
#if ASTRO_ON_CORTEX_M0
  return narrow::mul_wide(a, b);
#else
  return std::int64_t{a} * b;
#endif
}

/// round(a * b / 2^32), ties upward.
constexpr std::int32_t mul_high(std::int32_t a, std::int32_t b) {
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    std::int32_t high = 0;
    asm("smmulr %0, %1, %2" : "=r"(high) : "r"(a), "r"(b));
    return high;
  }
#endif
  return static_cast<std::int32_t>((mul_wide(a, b) + (std::int64_t{1} << 31)) >> 32);
}

/// sum + a * b; the sum must fit.
constexpr std::int64_t mul_add(std::int64_t sum, std::int32_t a, std::int32_t b) {
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    asm("smlal %Q0, %R0, %1, %2" : "+r"(sum) : "r"(a), "r"(b));
    return sum;
  }
#endif
  return sum + mul_wide(a, b);
}

/// The low 32 bits of round(a * b / 2^Bits), ties upward. The right shift leaves the rounding bit in the carry, so that it
/// takes three instructions; adding half a unit first takes a pair of registers to hold it, and six.
template <int Bits>
constexpr std::int32_t mul_rounded(std::int32_t a, std::int32_t b) {
  static_assert(Bits > 0 && Bits < 32);
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    std::int32_t low = 0, high = 0;
    asm("smull %[low], %[high], %[a], %[b]\n\t"
        "lsrs %[low], %[low], %[down]\n\t"
        "adc %[low], %[low], %[high], lsl %[up]"
        : [low] "=&r"(low), [high] "=&r"(high)
        : [a] "r"(a), [b] "r"(b), [down] "I"(Bits), [up] "I"(32 - Bits)
        : "cc");
    return low;
  }
#endif
  return static_cast<std::int32_t>((mul_wide(a, b) + (std::int64_t{1} << (Bits - 1))) >> Bits);
}

/// value * 2^bits, and 0 from 32 bits on, where the language leaves a shift undefined.
constexpr std::uint32_t shift_left(std::uint32_t value, int bits) {
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    std::uint32_t shifted = 0;
    asm("lsl %0, %1, %2" : "=r"(shifted) : "r"(value), "r"(bits));
    return shifted;
  }
#endif
  return bits < 32 ? value << bits : 0;
}

/// The low 64 bits of a * b.
constexpr std::int64_t mul_low(std::int64_t a, std::int32_t b) {
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    // a = high * 2^32 + low with a signed low: two multiplies.
    const auto low = static_cast<std::int32_t>(static_cast<std::uint32_t>(a));
    const std::uint32_t high = static_cast<std::uint32_t>(a >> 32) + (static_cast<std::uint32_t>(a) >> 31);
    return mul_wide(low, b) +
           static_cast<std::int64_t>(std::uint64_t{high * static_cast<std::uint32_t>(b)} << 32);
  }
#endif
#if ASTRO_ON_CORTEX_M0
  return narrow::mul_low(a, b);
#else
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) *
                                   static_cast<std::uint64_t>(std::int64_t{b}));
#endif
}

}  // namespace astro
