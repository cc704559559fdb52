#include "host/report/comparison.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <vector>

#include "host/report/numbers.hpp"

namespace astro::report {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Comparison, ReproducesTabulatedQuantilesOfStudentsT) {
  EXPECT_EQ(student_t_975(4), 2.776);
  EXPECT_NEAR(student_t_975(15), 2.131, 1e-3);  // tables print three decimals
  EXPECT_NEAR(student_t_975(30), 2.042, 1e-3);
  EXPECT_NEAR(student_t_975(120), 1.980, 1e-3);
}

TEST(Comparison, FactorOfExactValuesHasNoWidth) {
  const Improvement gain = improvement({300, 0, 5}, {60, 0, 5});
  EXPECT_DOUBLE_EQ(gain.factor, 5);
  EXPECT_DOUBLE_EQ(gain.standard_error, 0);
  EXPECT_DOUBLE_EQ(gain.low, 5);
  EXPECT_DOUBLE_EQ(gain.high, 5);
}

TEST(Comparison, FactorHasNoUpperBoundWhereTheRestCannotBeToldFromZero) {
  const Improvement gain = improvement({405, 40, 5}, {37, 40, 5});
  EXPECT_TRUE(std::isinf(gain.high));
  EXPECT_GT(gain.low, 1);
  EXPECT_THAT(describe(gain), HasSubstr("at least"));
}

TEST(Comparison, ClaimsNoMoreThanTheIntervalBears) {
  EXPECT_EQ(claim(improvement({405, 26, 5}, {90, 12, 5})), "4.5 times smaller");
  const Improvement unbounded = improvement({405, 40, 5}, {37, 40, 5});
  EXPECT_EQ(claim(unbounded),
            "at least " + fixed(unbounded.low, factor_decimals(unbounded.low)) + " times smaller");
  EXPECT_EQ(claim(improvement({90, 12, 5}, {405, 26, 5})), "4.5 times larger");
  for (const Estimate after : {Estimate{380, 30, 5}, Estimate{10, 300, 5}})
    EXPECT_EQ(claim(improvement({405, 40, 5}, after)), "not certainly changed");
  EXPECT_EQ(claim(improvement({400, kNaN, 1}, {100, kNaN, 1})), "4.0 times smaller") << "nothing is known";
}

TEST(Comparison, IntervalCoversTheTrueFactorInNineteenOfTwentyExperiments) {
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
    return Estimate{mean, std::sqrt((squares - kRuns * mean * mean) / (kRuns - 1) / kRuns), kRuns};
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

TEST(Comparison, SaysWhetherTheDifferenceIsSignificant) {
  EXPECT_EQ(judge({405, 30, 5}, {90, 24, 5}), Verdict::better);
  EXPECT_EQ(judge({90, 24, 5}, {405, 30, 5}), Verdict::worse);
  EXPECT_EQ(judge({90, 24, 5}, {37, 30, 5}), Verdict::undecided);  // the thesis's two methods
  EXPECT_EQ(judge({405, kNaN, 1}, {90, kNaN, 1}), Verdict::unknown);
  EXPECT_THAT(verdict_sentence({90, 24, 5}, {405, 30, 5}), HasSubstr("got worse"));
  EXPECT_THAT(verdict_sentence({90, 24, 5}, {37, 30, 5}), HasSubstr("not significant"));
  EXPECT_THAT(verdict_sentence({405, 0, 5}, {1, 0, 5}), HasSubstr("far beyond the scatter"));
}

TEST(Comparison, RootMeanSquareHasTheErrorThatItsScatterOverRepeatedExperimentsShows) {
  const unsigned seed = 11;
  std::mt19937 random(seed);
  std::normal_distribution<double> run(100, 30);
  double sum = 0, squares = 0, claimed = 0;
  constexpr int kExperiments = 5000;
  for (int i = 0; i < kExperiments; ++i) {
    std::vector<double> values(10);
    for (double& value : values) value = run(random);
    const Estimate rms = root_mean_square(values);
    sum += rms.value / kExperiments;
    squares += rms.value * rms.value / kExperiments;
    claimed += rms.standard_error / kExperiments;
  }
  // First order and ten runs: a few percent of bias, and 1 % of Monte Carlo noise.
  EXPECT_NEAR(claimed / std::sqrt(squares - sum * sum), 1, 0.06) << "seed " << seed;
}

}  // namespace astro::report
