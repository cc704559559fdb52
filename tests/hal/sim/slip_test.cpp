#include "hal/sim/slip.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace astro::sim {
namespace {

constexpr double kK_m = 2.645e-6;

TEST(Noise, QuantileInvertsTheNormalDistribution) {
  for (int i = 1; i < 4000; ++i) {
    const double p = i / 4000.0;
    EXPECT_NEAR(0.5 * std::erfc(-normal_quantile(p) / std::sqrt(2.0)), p, 1e-7);
  }
  // In the tail a relative error of the deviate x grows to x^2 times that of p.
  for (int exponent = 10; exponent < 53; ++exponent) {
    const double p = std::ldexp(1.0, -exponent);
    const double x = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-x / std::sqrt(2.0)) / p, 1.0, 2e-7 * x * x) << p;
  }
}

TEST(Noise, NeighbouringSeedsStreamsAndIndicesAreUnrelated) {
  constexpr int kCount = 20000;
  double along_seeds = 0, along_streams = 0, along_indices = 0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    along_seeds += gauss(i, 0, 0) * gauss(i + 1, 0, 0);
    along_streams += gauss(1, 0, i) * gauss(1, 1, i);
    along_indices += gauss(1, 0, i) * gauss(1, 0, i + 1);
  }
  const double bound = 4.0 / std::sqrt(kCount);  // four standard deviations of a mean of products
  EXPECT_NEAR(along_seeds / kCount, 0.0, bound);
  EXPECT_NEAR(along_streams / kCount, 0.0, bound);
  EXPECT_NEAR(along_indices / kCount, 0.0, bound);
}

// Sum of squared errors over K d is chi-square with n degrees: mean n, variance 2n. Five standard deviations.
TEST(Slip, VarianceIsKTimesDistanceAtEveryScale) {
  for (const double distance_m : {0.001, 0.010, 0.250}) {
    constexpr int kCount = 20000;
    Slip slip(7, 1, kK_m);
    double squares = 0.0, sum = 0.0;
    for (int i = 0; i < kCount; ++i) {
      const double error_m = slip.travel(distance_m) - distance_m;
      squares += error_m * error_m / (kK_m * distance_m);
      sum += error_m / std::sqrt(kK_m * distance_m);
    }
    EXPECT_NEAR(squares, kCount, 5.0 * std::sqrt(2.0 * kCount)) << distance_m << " m";
    EXPECT_NEAR(sum, 0.0, 5.0 * std::sqrt(kCount)) << "no bias at " << distance_m << " m";
  }
}

TEST(Slip, DependsOnTheWayAndNotOnHowItIsCut) {
  constexpr std::uint32_t kSeed = 11;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> portion(1e-7, 4e-3);
  Slip whole(3, 0, kK_m), pieces(3, 0, kK_m);
  double rolled_m = 0.0, travelled_m = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const double step_m = portion(random);
    rolled_m += step_m;
    travelled_m += pieces.travel(step_m);
  }
  EXPECT_NEAR(whole.travel(rolled_m), travelled_m, 1e-11) << "rounding of 5000 sums; seed " << kSeed;
  EXPECT_NE(travelled_m, rolled_m);
}

TEST(Slip, RollingBackSlipsAnew) {
  Slip slip(3, 0, kK_m);
  const double there_m = slip.travel(0.5), back_m = slip.travel(-0.5);
  EXPECT_LT(back_m, 0.0);
  EXPECT_GT(std::abs(there_m + back_m), 1e-6);
}

TEST(Slip, ZeroKIsExact) {
  Slip slip(3, 0, 0.0);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(slip.travel(3.7e-4), 3.7e-4);
}

TEST(Slip, WheelsAndSeedsSlipDifferently) {
  Slip left(3, 0, kK_m), right(3, 1, kK_m), other(4, 0, kK_m), again(3, 0, kK_m);
  const double travelled_m = left.travel(1.0);
  EXPECT_NE(travelled_m, right.travel(1.0));
  EXPECT_NE(travelled_m, other.travel(1.0));
  EXPECT_EQ(travelled_m, again.travel(1.0));
}

}  // namespace
}  // namespace astro::sim
