#include "host/simulation/robot/normal_deviates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace astro::simulation {
namespace {

TEST(NormalDeviates, AreThoseOfLibstdcxxNumberForNumber) {
#ifndef __GLIBCXX__
  GTEST_SKIP() << "this standard library has another way";
#endif
  std::mt19937_64 ours(5), theirs(5);
  NormalDeviates normal;
  std::normal_distribution<double> standard;
  for (int i = 0; i < 100'000; ++i) ASSERT_EQ(normal(ours), standard(theirs)) << i;
}

TEST(NormalDeviates, HaveTheMomentsOfTheNormalDistribution) {
  std::mt19937_64 random(6);
  NormalDeviates normal;
  constexpr int kCount = 1'000'000;
  double sum = 0, squares = 0, fourth = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = normal(random);
    sum += x, squares += x * x, fourth += x * x * x * x;
  }
  // Five standard errors of each moment.
  EXPECT_NEAR(sum / kCount, 0, 5 * std::sqrt(1.0 / kCount));
  EXPECT_NEAR(squares / kCount, 1, 5 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(fourth / kCount, 3, 5 * std::sqrt(96.0 / kCount));
}

}  // namespace
}  // namespace astro::simulation
