#include "hal/rp2040/arithmetic/duty_counts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace astro::rp2040 {
namespace {

constexpr int kFull = 32767;

template <class Claim>
void for_every_duty(Claim claim) {
  for (int duty = -kFull; duty <= kFull; ++duty) claim(static_cast<std::int16_t>(duty));
}

TEST(BridgeCounts, OneInputIsAlwaysHighSoThatTheMotorNeverFeelsTheOtherDirection) {
  for_every_duty([](std::int16_t duty) {
    const BridgeCounts counts = bridge_counts(duty);
    ASSERT_EQ(std::max(counts.in1, counts.in2), kPwmPeriod_counts) << duty;
  });
}

TEST(BridgeCounts, TheOtherIsLowForTheNearestCountToTheDuty) {
  for_every_duty([](std::int16_t duty) {
    const BridgeCounts counts = bridge_counts(duty);
    const long driven = long{counts.in1} - long{counts.in2};
    ASSERT_LE(std::labs(driven * kFull - long{duty} * long{kPwmPeriod_counts}), kFull / 2) << duty;
  });
}

TEST(BridgeCounts, NoDutyBrakesAndFullDriveNeverDoes) {
  EXPECT_EQ(bridge_counts(0), kBrake);
  EXPECT_EQ(bridge_counts(kFull), (BridgeCounts{kPwmPeriod_counts, 0}));
  EXPECT_EQ(bridge_counts(-kFull), (BridgeCounts{0, kPwmPeriod_counts}));
  EXPECT_EQ(bridge_counts(-32768), bridge_counts(-kFull)) << "which is no duty";
}

TEST(BridgeCounts, PeriodIsTwentyKilohertz) { EXPECT_EQ(125'000'000U / kPwmPeriod_counts, 20'000U); }

}  // namespace
}  // namespace astro::rp2040
