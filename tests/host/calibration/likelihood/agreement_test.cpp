#include "host/calibration/likelihood/agreement.hpp"

#include <gtest/gtest.h>

#include <random>

namespace astro::calibration {
namespace {

TEST(ChiSquareTail, HasTheTabledQuantiles) {
  // 5 % and 1 % points of the usual tables.
  EXPECT_NEAR(chi_square_tail(3.841, 1), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(5.991, 2), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(7.815, 3), 0.05, 1e-4);
  EXPECT_NEAR(chi_square_tail(11.345, 3), 0.01, 1e-4);
  EXPECT_NEAR(chi_square_tail(40.113, 27), 0.05, 1e-3);  // Wilson and Hilferty
  EXPECT_EQ(chi_square_tail(99, 0), 1);
}

/// Runs of equal information that each found the truth but for a normal error.
std::vector<Reduced> equal_runs(int count, double scatter, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0, scatter);
  std::vector<Reduced> runs;
  SharedVector sum = SharedVector::Zero();
  for (int i = 0; i < count; ++i) {
    Reduced run{SharedInformation::Identity() * 1e8, SharedVector::Zero()};
    for (int k = 0; k < 3; ++k) run.gradient[k] = normal(random) * 1e4;  // score: sqrt of the information
    sum += run.gradient;
    runs.push_back(run);
  }
  for (Reduced& run : runs) run.gradient -= sum / count;  // at the optimum they cancel
  return runs;
}

TEST(Dispersion, IsOneWhereRunsScatterAsTheirNoiseSays) {
  std::mt19937_64 random(1);
  for (const int count : {2, 3, 6}) {
    int widened = 0;
    for (int trial = 0; trial < 2000; ++trial)
      widened += dispersion(disagreements(equal_runs(count, 1, random), {})) > 1;
    // 1 % of 2000 are 20 +- 4.5.
    EXPECT_NEAR(widened, 20, 18) << count << " runs";
  }
}

TEST(Dispersion, TellsHowMuchMoreTheyScatter) {
  std::mt19937_64 random(2);
  double mean = 0;
  for (int trial = 0; trial < 500; ++trial)
    mean += dispersion(disagreements(equal_runs(8, 3, random), {})) / 500;
  EXPECT_NEAR(mean, 9, 0.5);  // 9 sqrt(2 / 21) of one trial over sqrt(500): 0.12
}

TEST(Disagreement, IsChiSquareOfThree) {
  std::mt19937_64 random(3);
  double mean = 0;
  for (int trial = 0; trial < 1000; ++trial)
    mean += disagreements(equal_runs(5, 1, random), {}).front().chi_square / 1000;
  EXPECT_NEAR(mean, 3, 4 * 2.45 / std::sqrt(1000));
  EXPECT_EQ(disagreements(equal_runs(1, 1, random), {}).front().degrees_of_freedom, 0);
}

}  // namespace
}  // namespace astro::calibration
