#pragma once

#include <compare>
#include <concepts>
#include <cstdint>

#include "common/fixed/saturate.hpp"

namespace astro {

/// Never defined: calling it at compile time is an error that shows its name.
void literal_does_not_fit_this_fixed();

/// Signed fixed point, F fraction bits in 32: range [-2^(31-F), 2^(31-F)), step 2^-F.
/// Sums and products saturate; products round to nearest, ties upward.
template <int F>
class Fixed {
  static_assert(F >= 0 && F < 32);

 public:
  static constexpr int kFractionBits = F;

  constexpr Fixed() = default;
  consteval explicit Fixed(double value) : raw_(nearest(value)) {}  // literals only: no run-time float

  static constexpr Fixed from_raw(std::int32_t raw) {
    Fixed result;
    result.raw_ = raw;
    return result;
  }
  constexpr std::int32_t raw() const { return raw_; }

  friend constexpr Fixed operator+(Fixed a, Fixed b) {
    return from_raw(saturate32(std::int64_t{a.raw_} + b.raw_));
  }
  friend constexpr Fixed operator-(Fixed a, Fixed b) {
    return from_raw(saturate32(std::int64_t{a.raw_} - b.raw_));
  }
  friend constexpr Fixed operator-(Fixed a) { return from_raw(saturate32(-std::int64_t{a.raw_})); }
  friend constexpr Fixed operator*(Fixed a, Fixed b) { return from_raw(saturate32(a.scale(b.raw_))); }
  friend constexpr auto operator<=>(Fixed, Fixed) = default;

  /// round(this * n) for an integer n of any unit, as a gain scales a signal. Ties upward.
  constexpr std::int64_t scale(std::int32_t n) const {
    if constexpr (F == 0) return std::int64_t{raw_} * n;
    return (std::int64_t{raw_} * n + (std::int64_t{1} << F >> 1)) >> F;
  }

 private:
  static consteval std::int32_t nearest(double value) {
    const double scaled = value * static_cast<double>(std::int64_t{1} << F);
    if (!(scaled >= -2147483648.5 && scaled < 2147483647.5)) literal_does_not_fit_this_fixed();
    return static_cast<std::int32_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
  }

  std::int32_t raw_ = 0;
};

using Q16 = Fixed<16>;

static_assert(!std::convertible_to<float, Q16>, "a float must never become fixed silently");
static_assert(!std::convertible_to<double, Q16>);
static_assert(Q16(30000.0) + Q16(30000.0) == Q16::from_raw(0x7FFF'FFFF), "saturates");

}  // namespace astro
