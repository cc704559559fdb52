#include "host/experiment/analysis/until.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace astro::experiment {
namespace {

using calibration::Precision;

TEST(Until, PrecisionIsToldInPercentToThreeDigitsEachUnderItsName) {
  EXPECT_EQ(described({0.00042, 0.00021, 0.0011}), "E_d ± 0.0420 %, S ± 0.0210 %, b ± 0.110 %");
  EXPECT_EQ(described({0.0123456, 0.2, 0.0567}), "E_d ± 1.23 %, S ± 20.0 %, b ± 5.67 %");
}

TEST(Until, IsReachedWhenAllThreeAreKnownAndAtTheTargetOrBelow) {
  constexpr double kTarget = 0.001, kMore = 0.00101, kUnknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(reaches({kTarget, kTarget, kTarget}, kTarget));
  EXPECT_TRUE(reaches({0, 0, 0}, kTarget));
  for (const double worse : {kMore, kUnknown}) {
    EXPECT_FALSE(reaches({worse, kTarget, kTarget}, kTarget));
    EXPECT_FALSE(reaches({kTarget, worse, kTarget}, kTarget));
    EXPECT_FALSE(reaches({kTarget, kTarget, worse}, kTarget));
  }
}

TEST(Until, PrecisionIsTheStandardErrorOverTheValue) {
  Calibration calibration;
  calibration.detail = MlResult{};
  calibration.factors.c_r = 1.1;
  calibration.factors.c_l = 0.9;
  calibration.factors.b_m = 0.5;
  calibration.se.E_d = 0.01;
  calibration.se.scale = 0.02;
  calibration.se.b_m = 0.03;
  const Precision precision = precision_of(calibration);
  EXPECT_NEAR(precision.E_d, 0.01 / (1.1 / 0.9), 1e-15);
  EXPECT_NEAR(precision.scale, 0.02 / 1.0, 1e-15);
  EXPECT_NEAR(precision.b, 0.03 / 0.5, 1e-15);
}

}  // namespace
}  // namespace astro::experiment
