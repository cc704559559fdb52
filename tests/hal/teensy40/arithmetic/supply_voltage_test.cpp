#include "hal/teensy40/arithmetic/supply_voltage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace astro::teensy40 {
namespace {

constexpr double kStep_mV = 1.0 * kSupplyFullScale_mV / kAdcFullScale;

/// What a converter without noise makes of a supply voltage.
std::uint32_t sample_of(double supply_mV) {
  const double pin_mV = supply_mV * kDividerLower_ohm / (kDividerUpper_ohm + kDividerLower_ohm);
  return static_cast<std::uint32_t>(std::lround(pin_mV / kAdcFullScale_mV * kAdcFullScale));
}

TEST(SupplyVoltage, ReadsWhatIsBeforeTheDivider) {
  for (int supply_mV = 0; supply_mV <= 30'000; supply_mV += 50) {
    SupplyVoltage voltage;
    voltage.prime(sample_of(supply_mV));
    // Half a converter step, and half a millivolt for the whole number.
    EXPECT_NEAR(voltage.millivolts(), supply_mV, kStep_mV / 2 + 0.5);
  }
}

TEST(SupplyVoltage, EndsAreZeroAndFullScale) {
  SupplyVoltage voltage;
  EXPECT_EQ(voltage.millivolts(), 0);
  voltage.prime(kAdcFullScale);
  EXPECT_EQ(voltage.millivolts(), static_cast<std::int32_t>(kSupplyFullScale_mV));
}

TEST(SupplyVoltage, PinNeverSeesMoreThanItBearsFromASixCellPack) {
  constexpr double kPack_mV = 25'200;
  EXPECT_LT(kPack_mV * kDividerLower_ohm / (kDividerUpper_ohm + kDividerLower_ohm), kAdcFullScale_mV);
}

TEST(SupplyVoltage, SettlesWithinTwoMillivoltsFromAboveAndBelow) {
  for (const std::uint32_t target : {0U, 1U, 1'500U, 1'619U, 4'095U})
    for (const std::uint32_t start : {0U, 4'095U}) {
      SupplyVoltage voltage;
      voltage.prime(start);
      for (int ms = 0; ms < 100; ++ms) voltage.add(target);
      EXPECT_NEAR(voltage.millivolts(), target * kStep_mV, 2.0) << start << " to " << target;
    }
}

/// Amplitude of the output over that of the input, once the start is forgotten.
double gain_at(double hertz) {
  SupplyVoltage voltage;
  voltage.prime(2'000);
  double in_phase = 0, quadrature = 0;
  constexpr int kSettled_ms = 200, kMeasured_ms = 1'000;  // whole periods of every whole frequency
  for (int ms = 0; ms < kSettled_ms + kMeasured_ms; ++ms) {
    const double angle = 2 * std::numbers::pi * hertz * ms / 1000;
    voltage.add(static_cast<std::uint32_t>(std::lround(2'000 + 1'500 * std::sin(angle))));
    if (ms < kSettled_ms) continue;
    in_phase += voltage.millivolts() * std::sin(angle);
    quadrature += voltage.millivolts() * std::cos(angle);
  }
  return std::hypot(in_phase, quadrature) * 2 / kMeasured_ms / (1'500 * kStep_mV);
}

TEST(SupplyVoltage, BandwidthIsFortySixHertz) {
  EXPECT_NEAR(gain_at(1), 1.0, 0.005);
  // y += (x - y) / 4 at 1 kHz: cos(w) = 1 - a^2 / (2 (1 - a)) with a = 1/4 is 46.1 Hz.
  EXPECT_NEAR(gain_at(46), std::numbers::sqrt2 / 2, 0.005) << "of rounding and of the rest of 0.1 Hz";
  EXPECT_LT(gain_at(100), 0.5) << "well below what hal/interface allows";
}

}  // namespace
}  // namespace astro::teensy40
