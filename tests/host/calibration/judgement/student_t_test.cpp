#include "host/calibration/judgement/student_t.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace astro::calibration {
namespace {

constexpr double kPrinted = 1e-3;  // tables print three decimals

TEST(StudentT, ReproducesTabulatedQuantiles) {
  EXPECT_EQ(student_t_975(4), 2.776);
  EXPECT_NEAR(student_t_975(15), 2.131, kPrinted);
  EXPECT_NEAR(student_t_975(30), 2.042, kPrinted);
  EXPECT_NEAR(student_t_975(120), 1.980, kPrinted);
  EXPECT_EQ(student_t_90(5), 1.476);
  EXPECT_NEAR(student_t_90(12), 1.356, kPrinted);
  EXPECT_NEAR(student_t_90(20), 1.325, kPrinted);
  EXPECT_NEAR(student_t_90(60), 1.296, kPrinted);
}

TEST(StudentT, KnowsNothingWithoutDegreesOfFreedom) {
  EXPECT_TRUE(std::isinf(student_t_975(0)));
  EXPECT_TRUE(std::isinf(student_t_90(0)));
}

TEST(ChiSquare, HasTheQuantilesOfTables) {
  EXPECT_EQ(chi_square_95(0), 0);
  EXPECT_NEAR(chi_square_95(1), 1.95996 * 1.95996, 1e-3);    // of one normal variable
  EXPECT_NEAR(chi_square_95(2), -2 * std::log(0.05), 1e-3);  // exponential
}

}  // namespace
}  // namespace astro::calibration
