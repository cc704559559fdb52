#include "host/calibration/judgement/before_after.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace astro::calibration {
namespace {

TEST(BeforeAfter, FactorOfExactValuesHasNoWidth) {
  const Improvement gain = improvement({300, 0, 5}, {60, 0, 5});
  EXPECT_DOUBLE_EQ(gain.factor, 5);
  EXPECT_DOUBLE_EQ(gain.standard_error, 0);
  EXPECT_DOUBLE_EQ(gain.low, 5);
  EXPECT_DOUBLE_EQ(gain.high, 5);
}

TEST(BeforeAfter, IntervalCoversTheTrueFactorInNineteenOfTwentyExperiments) {
  const unsigned seed = 7;
  std::mt19937 random(seed);
  constexpr int kExperiments = 4000, kRuns = 5;
  const auto measure = [&](double truth, double spread) {
    std::normal_distribution<double> run(truth, spread);
    double sum = 0, squares = 0;
    for (int i = 0; i < kRuns; ++i) {
      const double value = run(random);
      sum += value;
      squares += value * value;
    }
    const double mean = sum / kRuns;
    return FigureOfMerit{mean, std::sqrt((squares - kRuns * mean * mean) / (kRuns - 1) / kRuns), kRuns};
  };
  int covered = 0;
  for (int i = 0; i < kExperiments; ++i) {
    const Improvement gain = improvement(measure(400, 60), measure(90, 50));
    covered += gain.low <= 400.0 / 90 && 400.0 / 90 <= gain.high;
  }
  // Taking the smaller degrees of freedom errs on the safe side; the 95 % itself scatters by 0.35 %.
  EXPECT_GE(covered, 0.94 * kExperiments) << "seed " << seed;
  EXPECT_LE(covered, 0.99 * kExperiments) << "seed " << seed;
}

TEST(BeforeAfter, RootMeanSquareHasTheErrorThatItsScatterOverRepeatedExperimentsShows) {
  const unsigned seed = 11;
  std::mt19937 random(seed);
  std::normal_distribution<double> run(100, 30);
  double sum = 0, squares = 0, claimed = 0;
  constexpr int kExperiments = 5000;
  for (int i = 0; i < kExperiments; ++i) {
    std::vector<double> values(10);
    for (double& value : values) value = run(random);
    const FigureOfMerit rms = root_mean_square(values);
    sum += rms.value / kExperiments;
    squares += rms.value * rms.value / kExperiments;
    claimed += rms.standard_error / kExperiments;
  }
  // First order and ten runs: a few percent of bias, and 1 % of Monte Carlo noise.
  EXPECT_NEAR(claimed / std::sqrt(squares - sum * sum), 1, 0.06) << "seed " << seed;
}

constexpr double kNoError = std::numeric_limits<double>::quiet_NaN();

TEST(BeforeAfter, SaysWhetherTheDifferenceIsSignificant) {
  EXPECT_EQ(judge({405, 30, 5}, {90, 24, 5}), Verdict::better);
  EXPECT_EQ(judge({90, 24, 5}, {405, 30, 5}), Verdict::worse);
  EXPECT_EQ(judge({90, 24, 5}, {37, 30, 5}), Verdict::undecided);  // the thesis's two methods
  EXPECT_EQ(judge({405, kNoError, 1}, {90, kNoError, 1}), Verdict::unknown);
}

}  // namespace
}  // namespace astro::calibration
