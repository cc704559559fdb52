#include "common/fixed/trig.hpp"

#include <array>

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

constexpr int kStepsPerQuarter = 64;

consteval auto make_quarter_wave() {
  std::array<std::int64_t, kStepsPerQuarter + 1> table{};
  for (int i = 0; i <= kStepsPerQuarter; ++i) {
    const double value = sine(1.5707963267948966 * i / kStepsPerQuarter);
    table[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(value * 0x1p40 + 0.5);
  }
  return table;
}

constexpr auto kQuarterWave = make_quarter_wave();
static_assert(kQuarterWave[0] == 0 && kQuarterWave[kStepsPerQuarter] == std::int64_t{1} << 40);

SinCos at_grid(unsigned index) {
  const unsigned quadrant = index / kStepsPerQuarter % 4;
  const unsigned step = index % kStepsPerQuarter;
  const bool odd = (quadrant & 1U) != 0;
  const std::int64_t sine = kQuarterWave[odd ? kStepsPerQuarter - step : step];
  const std::int64_t cosine = kQuarterWave[odd ? step : kStepsPerQuarter - step];
  return {quadrant >= 2 ? -sine : sine, quadrant == 1 || quadrant == 2 ? -cosine : cosine};
}

constexpr std::int32_t high(std::int64_t product, int bits) {
  return static_cast<std::int32_t>(product >> bits);
}

}  // namespace

SinCos sin_cos(Angle angle) {
  const std::uint64_t nearest = angle.raw() + (std::uint64_t{1} << 55);
  const SinCos grid = at_grid(static_cast<unsigned>(nearest >> 56));
  const auto rest = static_cast<std::int64_t>((nearest & 0x00FF'FFFF'FFFF'FFFFU) - (std::uint64_t{1} << 55));

  // rho = rest in radians; the suffix is the number of fraction bits.
  constexpr std::int64_t kPiOver4_31 = 1686629713;
  constexpr std::int64_t kThird_32 = 0x5555'5555;
  constexpr std::int64_t kSixth_32 = 0x2AAA'AAAB;
  const std::int64_t rho_37 = high((rest >> 24) * kPiOver4_31 + (std::int64_t{1} << 30), 31);
  const std::int64_t half_square_44 = high(rho_37 * rho_37, 31);
  const std::int64_t cube_49 = high(rho_37 * half_square_44, 32);  // rho^3 / 2
  const std::int64_t sin_rho_37 = rho_37 - high(cube_49 * kThird_32, 44);
  const std::int64_t fourth_56 = high(half_square_44 * half_square_44, 32);  // rho^4 / 4
  const std::int64_t versed_44 = half_square_44 - high(fourth_56 * kSixth_32, 44);

  const std::int64_t sin_30 = high(grid.sin + 512, 10);
  const std::int64_t cos_30 = high(grid.cos + 512, 10);
  return {grid.sin + ((cos_30 * sin_rho_37 + (1 << 26)) >> 27) -
              ((sin_30 * versed_44 + (std::int64_t{1} << 33)) >> 34),
          grid.cos - ((sin_30 * sin_rho_37 + (1 << 26)) >> 27) -
              ((cos_30 * versed_44 + (std::int64_t{1} << 33)) >> 34)};
}

}  // namespace astro
