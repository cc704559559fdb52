#include "hal/teensy40/arithmetic/duty_counts.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace astro::teensy40 {
namespace {

constexpr int kFull = 32767;

template <class Claim>
void for_every_duty(Claim claim) {
  for (int duty = -kFull; duty <= kFull; ++duty) claim(static_cast<std::int16_t>(duty));
}

TEST(DutyCounts, NothingIsNothingAndFullIsTheWholePeriod) {
  EXPECT_EQ(duty_counts(0), 0U);
  EXPECT_EQ(duty_counts(kFull), kPwmPeriod_counts);
  EXPECT_EQ(duty_counts(-kFull), kPwmPeriod_counts);
}

TEST(DutyCounts, TheOneValueThatIsNoDutyIsFullDrive) { EXPECT_EQ(duty_counts(-32768), kPwmPeriod_counts); }

TEST(DutyCounts, BothDirectionsGetTheSame) {
  for_every_duty([](std::int16_t duty) {
    ASSERT_EQ(duty_counts(duty), duty_counts(static_cast<std::int16_t>(-duty))) << duty;
  });
}

TEST(DutyCounts, NearestCountForEveryDuty) {
  for_every_duty([](std::int16_t duty) {
    const long exact = std::labs(duty) * long{kPwmPeriod_counts};  // in counts * kFull
    ASSERT_LE(std::labs(long{duty_counts(duty)} * kFull - exact), kFull / 2) << duty;
  });
}

TEST(DutyCounts, JustBelowFullTheOutputFalls) {
  // A count is 4.4 steps of duty, so the two next to full round up to it.
  EXPECT_EQ(duty_counts(kFull - 2), kPwmPeriod_counts);
  EXPECT_EQ(duty_counts(kFull - 3), kPwmPeriod_counts - 1);
}

TEST(DutyCounts, PeriodIsTwentyKilohertz) { EXPECT_EQ(150'000'000U / kPwmPeriod_counts, 20'000U); }

}  // namespace
}  // namespace astro::teensy40
