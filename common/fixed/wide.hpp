#pragma once

#include <cstdint>

#include "common/fixed/multiply.hpp"

/// Wide integer arithmetic. The MCU's compiler has no __int128.
namespace astro {

/// round(a * b / 2^32), ties upward. |a| < 2^62.
constexpr std::int64_t mul_high(std::int64_t a, std::int32_t b) {
  const auto low = static_cast<std::int32_t>(static_cast<std::uint32_t>(a));
  const auto high = static_cast<std::int32_t>((a >> 32) + (low < 0 ? 1 : 0));
  return mul_add(mul_add(std::int64_t{1} << 31, low, b) >> 32, high, b);
}

/// (sum, rest) += a * b in 96 bits, of which `rest` holds the lowest 32, so that a long sum of products loses
/// nothing. |a| < 2^62.
///
/// Cost    seven instructions on the Cortex-M7; callable from the control tick.
constexpr void accumulate(std::int64_t& sum, std::uint32_t& rest, std::int64_t a, std::int32_t b) {
  // a = high * 2^32 + low with a signed low: then both products take one instruction.
  const auto low = static_cast<std::int32_t>(static_cast<std::uint32_t>(a));
  const auto high = static_cast<std::int32_t>((a >> 32) + (low < 0 ? 1 : 0));
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    std::int32_t p = 0, q = 0;
    asm("smull %[p], %[q], %[low], %[b]\n\t"
        "adds %[rest], %[rest], %[p]\n\t"
        "asr %[p], %[q], #31\n\t"
        "smlal %[q], %[p], %[high], %[b]\n\t"
        "adcs %Q[sum], %Q[sum], %[q]\n\t"
        "adc %R[sum], %R[sum], %[p]"
        : [sum] "+&r"(sum), [rest] "+&r"(rest), [p] "=&r"(p), [q] "=&r"(q)
        : [low] "r"(low), [high] "r"(high), [b] "r"(b)
        : "cc");
    return;
  }
#endif
  const std::int64_t lower = mul_add(rest, low, b);
  rest = static_cast<std::uint32_t>(lower);
  sum += mul_add(lower >> 32, high, b);
}

/// (high, low) += step in 96 bits, of which `high` holds the highest 32, signed.
constexpr void accumulate(std::int32_t& high, std::uint64_t& low, std::int64_t step) {
#if ASTRO_ON_CORTEX_M7
  if (!std::is_constant_evaluated()) {
    asm("adds %Q[low], %Q[low], %Q[step]\n\t"
        "adcs %R[low], %R[low], %R[step]\n\t"
        "adc %[high], %[high], %R[step], asr #31"
        : [low] "+&r"(low), [high] "+&r"(high)
        : [step] "r"(step)
        : "cc");
    return;
  }
#endif
  low += static_cast<std::uint64_t>(step);
  high += (step < 0 ? -1 : 0) + (low < static_cast<std::uint64_t>(step) ? 1 : 0);
}

/// The largest r with r * r <= n.
///
/// Cost    32 rounds; for planning, not for the tick.
constexpr std::uint32_t isqrt(std::uint64_t n) {
  std::uint64_t root = 0;
  for (std::uint64_t bit = std::uint64_t{1} << 62; bit != 0; bit >>= 2) {
    const std::uint64_t trial = root + bit;
    root >>= 1;
    if (n >= trial) {
      n -= trial;
      root += bit;
    }
  }
  return static_cast<std::uint32_t>(root);
}

/// A 256-bit natural number for formulas that run once per parameter change: exact products of many factors,
/// then exact division. The caller must rule out an overflow of 256 bits (tests/common/fixed sweeps the
/// extremes).
class Natural {
 public:
  constexpr explicit Natural(std::uint64_t value)
      : limbs_{static_cast<std::uint32_t>(value), static_cast<std::uint32_t>(value >> 32)} {}

  constexpr Natural& operator*=(std::uint32_t factor) {
    std::uint64_t carry = 0;
    for (std::uint32_t& limb : limbs_) {
      carry += std::uint64_t{limb} * factor;
      limb = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    return *this;
  }

  /// Floor division. Dividing by a and then by b is dividing by a * b. `divisor` is not 0.
  constexpr Natural& operator/=(std::uint32_t divisor) {
    std::uint64_t rest = 0;
    for (int i = kLimbs - 1; i >= 0; --i) {
      const std::uint64_t part = (rest << 32) | limbs_[i];
      limbs_[i] = static_cast<std::uint32_t>(part / divisor);
      rest = part % divisor;
    }
    return *this;
  }

  constexpr Natural& operator<<=(int bits) {
    for (; bits >= 16; bits -= 16) *this *= std::uint32_t{1} << 16;
    return *this *= std::uint32_t{1} << bits;
  }

  constexpr bool fits_63_bits() const {
    for (int i = 2; i < kLimbs; ++i)
      if (limbs_[i] != 0) return false;
    return (limbs_[1] >> 31) == 0;
  }

  /// Half of the number, rounded to nearest; saturates at 2^63 - 1. Compute with one extra bit, then call
  /// this.
  constexpr std::int64_t half_rounded() const {
    Natural rounded = *this;
    for (std::uint32_t& limb : rounded.limbs_)
      if (++limb != 0) break;
    rounded /= 2;
    if (!rounded.fits_63_bits()) return INT64_MAX;
    return static_cast<std::int64_t>(std::uint64_t{rounded.limbs_[1]} << 32 | rounded.limbs_[0]);
  }

 private:
  static constexpr int kLimbs = 8;
  std::uint32_t limbs_[kLimbs];
};

}  // namespace astro
