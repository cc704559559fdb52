#include "hal/rp2040/arithmetic/supply_voltage.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace astro::rp2040 {
namespace {

TEST(PicoSupplyVoltage, EverySampleIsWithinTwoMillivoltsOfTheDivider) {
  for (std::uint32_t sample = 0; sample <= kAdcFullScale; ++sample) {
    SupplyVoltage voltage;
    voltage.prime(sample);
    ASSERT_LE(std::abs(voltage.millivolts() - sample * 3300.0 / 4095 * 9.2), 2.0) << sample;
  }
}

TEST(PicoSupplyVoltage, StepSettlesWithinAThousandthInThirtySamples) {
  SupplyVoltage voltage;
  voltage.prime(0);
  for (int i = 0; i < 30; ++i)
    voltage.add(2000);  // 0.75^30 = 0.0002; the rounding of the filter adds 3/16 of a step
  SupplyVoltage settled;
  settled.prime(2000);
  EXPECT_NEAR(voltage.millivolts(), settled.millivolts(), settled.millivolts() * 0.001);
}

}  // namespace
}  // namespace astro::rp2040
