#include "common/fixed/trig.hpp"

namespace astro::trig {
namespace {

// Computed in double, which every compiler rounds in the same way, so that the table and the odometry have
// the same bits on the host and on the MCU. (long double differs between the two.)
consteval double sine(double x) {
  double term = x;
  double sum = x;
  for (int n = 1; n < 16; ++n) {
    term *= -x * x / ((2 * n) * (2 * n + 1));
    sum += term;
  }
  return sum;
}

consteval std::int64_t sine_of_step(std::size_t step) {
  const std::size_t quadrant = step / kQuarter % 4;
  const std::size_t rest = step % kQuarter;
  const std::size_t rising = quadrant % 2 != 0 ? kQuarter - rest : rest;
  const double value = sine(1.5707963267948966 * static_cast<double>(rising) / kQuarter);
  const auto rounded = static_cast<std::int64_t>(value * 0x1p43 + 0.5);
  return quadrant >= 2 ? -rounded : rounded;
}

consteval auto make_wave() {
  std::array<std::int64_t, kSteps + kQuarter> wave{};
  for (std::size_t step = 0; step < wave.size(); ++step) wave[step] = sine_of_step(step) + kHalfOf30;
  return wave;
}

}  // namespace

constexpr std::array<std::int64_t, kSteps + kQuarter> kWave = make_wave();
static_assert(kWave[0] == kHalfOf30 &&
              kWave[kQuarter] == (std::int64_t{1} << SinCos::kFractionBits) + kHalfOf30);

}  // namespace astro::trig
