#include "host/report/numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace astro::report {

TEST(ReportNumbers, UseARealMinusSignAndNeverShowMinusZero) {
  EXPECT_EQ(fixed(-12.3, 2), "−12.30");
  EXPECT_EQ(fixed(-0.004, 2), "0.00");
  EXPECT_EQ(fixed(0.005, 1), "0.0");
}

TEST(ReportNumbers, ShowADashForTheUnknownAndASignForTheInfinite) {
  EXPECT_EQ(fixed(std::nan(""), 2), "–");
  EXPECT_EQ(fixed(-INFINITY, 2), "−∞");
}

TEST(ReportNumbers, HaveTheTwoDigitsThatTheirStandardErrorSupports) {
  EXPECT_EQ(with_error(404.987, 26.3, 1), "405 ± 26");
  EXPECT_EQ(with_error(12.345, 3.21, 1), "12.3 ± 3.2");
  EXPECT_EQ(with_error(1.00207703, 0.000123, 1), "1.00208 ± 0.00012");
  EXPECT_EQ(with_error(404.987, std::nan(""), 1), "405.0");
  EXPECT_EQ(with_error(0.12, 0.0, 2), "0.12 ± 0.00");
}

TEST(ReportNumbers, ShowSixSignificantDigitsOfAParameterWithoutError) {
  EXPECT_EQ(fixed(0.28861105, six_digits(0.28861105)), "0.288611");
  EXPECT_EQ(fixed(1.00207703, six_digits(1.00207703)), "1.00208");
  EXPECT_EQ(fixed(2803.2, six_digits(2803.2)), "2803.20");
}

}  // namespace astro::report
