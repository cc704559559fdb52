#include "hal/teensy40/arithmetic/uart_divider.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace astro::teensy40 {
namespace {

constexpr std::uint32_t kCrystal_Hz = 24'000'000;

double error_of(std::uint32_t baud) {
  return 1.0 * kCrystal_Hz / uart_divider(kCrystal_Hz, baud).total() / baud - 1.0;
}

TEST(UartDivider, OneMegabitIsExact) {
  const UartDivider divider = uart_divider(kCrystal_Hz, 1'000'000);
  EXPECT_EQ(divider.samples, 24U);
  EXPECT_EQ(divider.divisor, 1U);
}

TEST(UartDivider, UsualRatesAreOffByLittle) {
  for (const std::uint32_t baud : {9'600U, 115'200U, 230'400U, 460'800U, 921'600U})
    EXPECT_LT(std::abs(error_of(baud)), 0.0017) << baud;  // 24 MHz / 26 is 923,077: 0.16 %
  for (const std::uint32_t baud : {250'000U, 500'000U, 1'000'000U, 2'000'000U, 3'000'000U})
    EXPECT_EQ(error_of(baud), 0.0) << baud;
}

TEST(UartDivider, StaysWithinWhatTheRegisterHolds) {
  for (std::uint32_t baud = 300; baud <= 6'000'000; baud += baud / 50 + 1) {
    const UartDivider divider = uart_divider(kCrystal_Hz, baud);
    ASSERT_GE(divider.samples, 4U) << baud;
    ASSERT_LE(divider.samples, 32U) << baud;
    ASSERT_GE(divider.divisor, 1U) << baud;
    ASSERT_LE(divider.divisor, 8191U) << baud;
  }
}

TEST(UartDivider, RegisterHasOneSampleLessTheDivisorAndBothEdgesWhereSamplesAreFew) {
  EXPECT_EQ((UartDivider{24, 1}.baud_register()), 23U << 24 | 1U);
  EXPECT_EQ((UartDivider{8, 3}.baud_register()), 7U << 24 | 3U);
  EXPECT_EQ((UartDivider{4, 6}.baud_register()), 3U << 24 | 1U << 17 | 6U);
}

}  // namespace
}  // namespace astro::teensy40
