#include "common/fixed/trig.hpp"

#include <array>

#include "common/fixed/multiply.hpp"

namespace astro {
namespace {

// Computed in double, whose rounding is the same on every compiler that builds us: the table, and so
// odometry, has the same bits on the host and on the MCU. (long double differs between the two.)
consteval double sine(double x) {
  double term = x;
  double sum = x;
  for (int n = 1; n < 16; ++n) {
    term *= -x * x / ((2 * n) * (2 * n + 1));
    sum += term;
  }
  return sum;
}

constexpr int kSteps = 256;  // per turn
constexpr int kQuarter = kSteps / 4;

consteval std::int64_t grid_sine(int step) {
  const int quadrant = step / kQuarter % 4;
  const int rest = step % kQuarter;
  const double value = sine(1.5707963267948966 * (quadrant % 2 != 0 ? kQuarter - rest : rest) / kQuarter);
  const auto rounded = static_cast<std::int64_t>(value * 0x1p43 + 0.5);
  return quadrant >= 2 ? -rounded : rounded;
}

// A turn and a quarter, so that the cosine is the sine a quarter further on.
consteval auto make_wave() {
  std::array<std::int64_t, kSteps + kQuarter> table{};
  for (int step = 0; step < kSteps + kQuarter; ++step)
    table[static_cast<std::size_t>(step)] = grid_sine(step);
  return table;
}

constexpr auto kWave = make_wave();
static_assert(kWave[0] == 0 && kWave[kQuarter] == std::int64_t{1} << SinCos::kFractionBits);

constexpr std::int32_t rounded_30(std::int64_t value_43) {
  return static_cast<std::int32_t>((value_43 + 4096) >> 13);
}

// Coefficients of sin and 1 - cos of rho = x pi / 256 in x, the suffix is the number of fraction bits.
constexpr double kRho = 3.141592653589793 / kSteps;
constexpr auto kLinear_37 = static_cast<std::int32_t>(kRho * 0x1p37 + 0.5);
constexpr auto kCubic_39 = static_cast<std::int32_t>(kRho * kRho * kRho / 6 * 0x1p39 + 0.5);
constexpr auto kSquare_38 = static_cast<std::int32_t>(kRho * kRho / 2 * 0x1p38 + 0.5);
constexpr auto kFourth_40 = static_cast<std::int32_t>(kRho * kRho * kRho * kRho / 24 * 0x1p40 + 0.5);

}  // namespace

SinCos sin_cos(Angle angle) {
  const std::uint64_t nearest = angle.raw() + (std::uint64_t{1} << 55);
  const auto step = static_cast<std::size_t>(nearest >> 56);
  const std::int64_t sine = kWave[step];
  const std::int64_t cosine = kWave[step + kQuarter];
  const std::int32_t sine_30 = rounded_30(sine);
  const std::int32_t cosine_30 = rounded_30(cosine);

  // What is left to the angle, as a part of half a step: x in [-1, 1).
  const auto x_31 = static_cast<std::int32_t>(static_cast<std::uint32_t>(nearest >> 24) ^ 0x8000'0000U);
  const std::int32_t square_30 = mul_high(x_31, x_31);
  const std::int32_t sin_rho_36 = mul_high(x_31, kLinear_37 - mul_high(square_30, kCubic_39));
  const std::int32_t versed_36 = mul_high(square_30, kSquare_38 - mul_high(square_30, kFourth_40));

  constexpr std::int64_t kHalf = 1 << 22;
  const std::int64_t up = mul_add(mul_add(kHalf, cosine_30, sin_rho_36), sine_30, -versed_36);
  const std::int64_t across = mul_add(mul_add(kHalf, cosine_30, -versed_36), sine_30, -sin_rho_36);
  return {sine + (up >> 23), cosine + (across >> 23)};
}

}  // namespace astro
