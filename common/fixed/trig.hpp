#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/fixed/angle.hpp"
#include "common/fixed/multiply.hpp"

namespace astro {

/// Sine and cosine as Q20.43: 2^43 is one.
struct SinCos {
  static constexpr int kFractionBits = 43;
  std::int64_t sin = 0;
  std::int64_t cos = 0;
};

namespace trig {

inline constexpr std::size_t kSteps = 256;  // per turn
inline constexpr std::size_t kQuarter = kSteps / 4;

/// The sine of every step, for a turn and a quarter, because the cosine is the sine a quarter turn later.
/// Half a unit of the 30th fraction bit is added, so that truncating an entry to 30 bits rounds it.
inline constexpr std::int64_t kHalfOf30 = 1 << 12;
extern const std::array<std::int64_t, kSteps + kQuarter> kWave;

// Coefficients of sin and 1 - cos of rho = x pi / 256 in x; the suffix is the number of fraction bits.
inline constexpr double kRho = 3.141592653589793 / kSteps;
inline constexpr auto kLinear_37 = static_cast<std::int32_t>(kRho * 0x1p37 + 0.5);
inline constexpr auto kCubic_39 = static_cast<std::int32_t>(kRho * kRho * kRho / 6 * 0x1p39 + 0.5);
inline constexpr auto kSquare_38 = static_cast<std::int32_t>(kRho * kRho / 2 * 0x1p38 + 0.5);
inline constexpr auto kFourth_40 = static_cast<std::int32_t>(kRho * kRho * kRho * kRho / 24 * 0x1p40 + 0.5);

}  // namespace trig

/// Sine and cosine of a binary angle. The absolute error is below 2^-35 (tests/common/fixed sweeps it);
/// multiples of a quarter turn are exact. One step would need only 2^-30, but on a straight line the same
/// error adds up in every tick, and half an hour at 1 m/s must stay within a micrometre.
///
/// Method  a table of 64 steps per quarter turn, then a Taylor series to the fourth power of the rest, which
///         is at most 0.0123 rad
/// Cost    constant, about 50 instructions, no division; callable from the control tick
inline SinCos sin_cos(Angle angle) {
  const std::uint64_t nearest = angle.raw() + (std::uint64_t{1} << 55);
  const auto step = static_cast<std::size_t>(nearest >> 56);
  const std::int64_t sine = trig::kWave[step];
  const std::int64_t cosine = trig::kWave[step + trig::kQuarter];
  const auto sine_30 = static_cast<std::int32_t>(sine >> 13);
  const auto cosine_30 = static_cast<std::int32_t>(cosine >> 13);

  // The rest of the angle, in units of half a step: x in [-1, 1).
  const auto x_31 = static_cast<std::int32_t>(static_cast<std::uint32_t>(nearest >> 24) ^ 0x8000'0000U);
  const std::int32_t square_30 = mul_high(x_31, x_31);
  const std::int32_t sin_rho_36 = mul_high(x_31, trig::kLinear_37 - mul_high(square_30, trig::kCubic_39));
  const std::int32_t versed_36 =
      mul_high(square_30, trig::kSquare_38 - mul_high(square_30, trig::kFourth_40));

  constexpr std::int64_t kHalf = (1 << 22) - (trig::kHalfOf30 << 23);
  const std::int64_t up = mul_add(mul_add(kHalf, cosine_30, sin_rho_36), sine_30, -versed_36);
  const std::int64_t across = mul_add(mul_add(kHalf, cosine_30, -versed_36), sine_30, -sin_rho_36);
  return {sine + (up >> 23), cosine + (across >> 23)};
}

}  // namespace astro
