#pragma once

#include <bit>
#include <cstdint>

#include "common/fixed/multiply.hpp"
#include "common/params/parameter_set.hpp"

namespace astro {

/// The curvature effect of real tyres: a spin turns about b, a gentle arc about b (1 + e), and what lies between about
///
///   b (1 + e g),   g = kappa0 s / (kappa0 s + d),   s = |R + L| / 2,   d = |R - L|
///
/// with the wheel speeds R and L. Odometry needs the inverse of 1 + e g. Commands need e g of a body speed, of which
/// d = |omega| b (1 + e g) is not known; the second formula solves that for e g up to the second power of e. Both take
/// one division, because each is a weight k times a speed over the same plus another speed:
///
///   1 / (1 + e g) = 1 - h e / (1 + e),          h = k s / (k s + d),                    k = kappa0 (1 + e)
///   e g = e G + e^2 (1 - e/2) G (1 - G) (1/2 - G),   G = k |v| / (k |v| + |omega| b / 2),   k = kappa0 / (2 + e)
///
/// Errors  h and G are at most 5e-5 too small. Besides, the first is that of wheel speeds wrong by 3 max(1, kappa0) um/s,
///         the second moves a wheel by |e| (10 + kappa0) um/s, and what the second leaves out of the series is below 0.022 |e|^3.
/// Cost    constant, one division; callable from the control tick
class EffectiveBase {
 public:
  EffectiveBase() = default;
  /// Precondition: `set` is valid (common/params).
  [[gnu::cold]] explicit EffectiveBase(const ParameterSet& set);

  /// e is not 0. If it is, every wheelbase is b and the rest need not be asked.
  bool varies() const { return varies_ > 0; }

  /// 1 / (1 + e g) - 1 in 2^-32 of measured wheel speeds, from their sum and their difference. At rest: 0.
  [[gnu::always_inline]] std::int32_t inverse_32(std::int32_t sum_umps, std::int32_t difference_umps) const;
  /// e g in 2^-32 of a commanded speed; `half_4umps` is omega b / 2 in 4e-6 m/s. At rest, and in a spin: 0.
  [[gnu::always_inline]] std::int32_t widening_32(std::int32_t v_umps, std::int32_t half_4umps) const;

 private:
  // 1 or -1. After a comparison with 0 the compiler would keep that 0 in a register and add it to products.
  std::int32_t varies_ = -1;
  std::int32_t narrowing_33_ = 0;  // -e / (1 + e)
  // The weight of |R + L|, which is k / 2, is measured_weight_ in 2^-(32 - measured_shift_): as fine as 32 bits allow.
  std::uint32_t measured_weight_ = 0;
  std::uint32_t measured_shift_ = 0;
  std::uint32_t commanded_weight_29_ = 0;
  // e g as a polynomial of G. A product with G, which has 31 bits, loses one bit.
  std::int32_t linear_33_ = 0, quadratic_34_ = 0, cubic_35_ = 0;
};

namespace effective_base_detail {

// |value|, or one less if it is negative: one instruction, and never an overflow.
constexpr std::uint32_t size_of(std::int32_t value) {
  return static_cast<std::uint32_t>(value ^ (value >> 31));
}

constexpr std::uint32_t scaled(std::uint32_t value, std::uint32_t weight_32) {
  return static_cast<std::uint32_t>((std::uint64_t{value} * weight_32) >> 32);
}

// part / (part + rest) in 2^-31, at most 5e-5 too small and always below 1; 0 if both are 0. Their sum is below 2^32.
constexpr std::int32_t share_31(std::uint32_t part, std::uint32_t rest) {
  const std::uint32_t whole = part + rest;
  const int free_bits = std::countl_zero(whole);
  // 16 bits of the whole, rounded up, leave 16 for the quotient.
  const std::uint32_t share_16 = shift_left(part, free_bits) / ((shift_left(whole, free_bits) >> 16) + 1);
  return static_cast<std::int32_t>(share_16 << 15);
}

}  // namespace effective_base_detail

inline std::int32_t EffectiveBase::inverse_32(std::int32_t sum_umps, std::int32_t difference_umps) const {
  using namespace effective_base_detail;
  const std::uint32_t along = scaled(size_of(sum_umps), measured_weight_);
  return mul_high(narrowing_33_, share_31(along, size_of(difference_umps) >> measured_shift_));
}

inline std::int32_t EffectiveBase::widening_32(std::int32_t v_umps, std::int32_t half_4umps) const {
  using namespace effective_base_detail;
  // Both in 8e-6 m/s, so that the largest weight fits into 32 bits.
  const std::int32_t share =
      share_31(scaled(size_of(v_umps), commanded_weight_29_), size_of(half_4umps) >> 1);
  const std::int32_t second = quadratic_34_ + mul_high(cubic_35_, share);
  return mul_high(linear_33_ + mul_high(second, share), share);
}

}  // namespace astro
