#include "host/calibration/likelihood/agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

/// Runs of one course in stretches of equal information, with scores of variance 1 in units of the noise, and the errors that the noise does not know:
/// one for each run and one for each place of the course.
struct Clustered {
  std::vector<RunInStretches> runs;
  double error = 0;  // of the estimate: chi-square of 3 if the noise explains it
};

Clustered clustered(int runs, double of_run, double of_place, std::mt19937_64& random) {
  constexpr int kStretches = 8;
  constexpr double kRoot = 1e4;  // of the information
  std::normal_distribution<double> normal;
  const auto three = [&](double size) -> Eigen::Vector3d {
    return size * Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  std::vector<Eigen::Vector3d> places;
  for (int k = 0; k < kStretches; ++k) places.push_back(three(of_place));
  Clustered all;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < runs; ++i) {
    all.runs.emplace_back();
    const Eigen::Vector3d whole = three(of_run);
    for (const Eigen::Vector3d& place : places) {
      const Eigen::Vector3d score = three(1) + whole + place;
      sum += score;
      Reduced stretch{SharedInformation::Identity() * kRoot * kRoot, SharedVector::Zero()};
      stretch.gradient.head<3>() = kRoot * score;
      all.runs.back().stretches.push_back(stretch);
    }
  }
  all.error = sum.squaredNorm() / (runs * kStretches);
  for (RunInStretches& run : all.runs)  // at the optimum they cancel
    for (Reduced& stretch : run.stretches) stretch.gradient.head<3>() -= kRoot * sum / (runs * kStretches);
  return all;
}

constexpr bool kAll = false, kSpaced = true;  // the truth that is used

/// Squares of the errors over what is claimed, on average.
double claimed(int runs, double of_run, double of_place, bool truth_is_spaced) {
  std::mt19937_64 random(4);
  constexpr int kTrials = 400;
  double mean = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Clustered all = clustered(runs, of_run, of_place, random);
    mean += all.error / clustered_dispersion(all.runs, {}, truth_is_spaced) / kTrials;
  }
  return mean;
}

// 3 +- 3 standard deviations of the mean of 400 chi-squares of 3.
constexpr double kChance = 3 * 2.45 / 20;

// Circles find e, and the flicker of counts on the lines of squares says that it is something else.
TEST(Disagreement, IsNotAboutWhatARunHardlyObservesAmongCloseSamples) {
  constexpr double kShare = 3e-4, kRoot = 1e4;
  std::vector<Reduced> runs(6, {SharedInformation::Identity() * kRoot * kRoot, SharedVector::Zero()});
  runs[0].information(kB, kB) *= kShare * static_cast<double>(runs.size());
  runs[0].gradient[kB] = 10 * kRoot * std::sqrt(kShare);
  runs[1].gradient[kB] = -runs[0].gradient[kB];
  const Disagreement close = disagreements(runs, {}, kAll).front(),
                     spaced = disagreements(runs, {}, kSpaced).front();
  EXPECT_EQ(close.degrees_of_freedom, 2);
  EXPECT_EQ(spaced.degrees_of_freedom, 3);
  EXPECT_LT(close.chi_square, 0.1);
  EXPECT_GT(spaced.chi_square, 10);
}

TEST(ClusteredDispersion, LeavesANoiseModelAloneThatHoldsForAllTruth) {
  std::mt19937_64 random(5);
  for (const int count : {2, 6}) {
    int widened = 0;
    for (int trial = 0; trial < 1000; ++trial)
      widened += clustered_dispersion(clustered(count, 0, 0, random).runs, {}, kAll) > 1;
    EXPECT_LT(widened, 20 + 3 * 4.5) << "two tests of one in a hundred; " << count << " runs";
    EXPECT_NEAR(claimed(count, 0, 0, kAll), 3, kChance);
  }
}

TEST(ClusteredDispersion, MakesClaimsHoldWhereErrorsLastForARun) {
  EXPECT_NEAR(claimed(6, 0, 0, kSpaced), 3 - 0.3, kChance) << "at least 1 where chance says less";
  EXPECT_NEAR(claimed(10, 0.7, 0, kSpaced), 3, 1) << "without it 15";
}

TEST(ClusteredDispersion, MakesClaimsHoldWhereErrorsReturnAtTheSamePlaces) {
  EXPECT_NEAR(claimed(6, 0, 0.7, kSpaced), 3, 1) << "without it 12";
  EXPECT_NEAR(claimed(6, 0, 0.7, kAll), 3, 1);
  std::mt19937_64 random(6);
  double runs = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Reduced> whole;
    for (const RunInStretches& run : clustered(6, 0, 0.7, random).runs) {
      whole.push_back(run.stretches.front());
      for (std::size_t k = 1; k < run.stretches.size(); ++k) {
        whole.back().information += run.stretches[k].information;
        whole.back().gradient += run.stretches[k].gradient;
      }
    }
    runs += scatter(disagreements(whole, {})).ratio() / 200;
  }
  EXPECT_NEAR(runs, 1, 3 * std::sqrt(2.0 / 15 / 200)) << "between runs such errors do not show";
}

TEST(ClusteredDispersion, DoesNotCountAnOutlier) {
  std::mt19937_64 random(7);
  Clustered all = clustered(6, 0, 0, random);
  for (Reduced& stretch : all.runs[2].stretches) stretch.gradient[0] += 4e4;
  for (RunInStretches& run : all.runs)
    for (Reduced& stretch : run.stretches) stretch.gradient[0] -= 4e4 / 6;
  EXPECT_GT(clustered_dispersion(all.runs, {}, kAll), 2);
  all.runs[2].outlier = true;
  EXPECT_EQ(clustered_dispersion(all.runs, {}, kAll), 1);
}

}  // namespace
}  // namespace astro::calibration
