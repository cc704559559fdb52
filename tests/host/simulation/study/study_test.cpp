#include "host/simulation/study/study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "host/simulation/study/kinematic_source.hpp"
#include "host/simulation/study/shard_file.hpp"
#include "host/simulation/study/summary.hpp"
#include "tests/host/calibration/end_poses/square_runs.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/thorough.hpp"

namespace astro::simulation::study {
namespace {

const KinematicSource kRobot;
const auto kSilent = [](int, int) {};

TrialSetup small_setup(int trials) {
  TrialSetup setup;
  setup.trials = trials;
  setup.runs = 1;
  setup.side_m = 1;
  setup.clock_known = false;
  return setup;
}

TEST(Study, ShardsMergedAreTheWholeToTheLastBitWhateverTheJobs) {
  const TrialSetup setup = small_setup(7);
  const std::vector<Trial> whole = run_study(setup, kRobot, {1, 1}, 1, kSilent);
  std::vector<ShardFile> parts;
  for (const int number : {3, 1, 2})
    parts.push_back(read_shard_file(to_text(setup, run_study(setup, kRobot, {number, 3}, 4, kSilent)),
                                    std::to_string(number)));
  EXPECT_EQ(merge(parts), whole);
  const Summary a = summarize(setup, kRobot, whole), b = summarize(setup, kRobot, merge(parts));
  ASSERT_EQ(a.methods.size(), kMethods.size());
  for (std::size_t m = 0; m < a.methods.size(); ++m) {
    EXPECT_EQ(a.methods[m].rms, b.methods[m].rms);
    EXPECT_EQ(a.methods[m].se, b.methods[m].se);
  }
  EXPECT_EQ(a.bound.rms, b.bound.rms);
}

TEST(Study, AnotherSeedIsAnotherStudy) {
  TrialSetup setup = small_setup(1);
  const std::vector<Trial> first = run_study(setup, kRobot, {1, 1}, 1, kSilent);
  setup.seed = 2;
  EXPECT_NE(run_study(setup, kRobot, {1, 1}, 1, kSilent), first);
}

TEST(Study, WhoeverWatchesCanEndIt) {
  const auto enough = [](int, int) { throw std::runtime_error("enough"); };
  EXPECT_THROW(run_study(small_setup(100000), kRobot, {1, 1}, 1, enough), std::runtime_error);
}

TEST(Study, AnEmptyShardIsRefused) {
  EXPECT_THAT(support::told_by([] {
                run_study(small_setup(3), kRobot, {1, 4}, 1, kSilent);
              }),
              support::Tells(StudyProblem::shard_empty, "1", "4", "3"));
}

// `astrolabe study` checks the full claims over hundreds of trials of ten squares; here are enough trials to
// notice a loss of some 25 %.
class MaximumLikelihoodStudy : public testing::TestWithParam<bool> {};

TEST_P(MaximumLikelihoodStudy, ReachesTheBoundWithAnHonestCovariance) {
  TrialSetup setup;
  setup.trials = 100;
  setup.runs = 1;
  setup.side_m = 1;
  setup.clock_known = GetParam();
  const Summary summary = summarize(setup, kRobot, run_study(setup, kRobot, {1, 1}, 2, kSilent));
  EXPECT_TRUE(summary.failures.empty());
  for (const Ratio& ratio : summary.ml_over_bound) {
    EXPECT_LT(ratio.value, 1 + 3 * ratio.se);
    EXPECT_GT(ratio.value, 1 - 3 * ratio.se) << "nobody is better than the bound";
  }
  ASSERT_TRUE(summary.ml_covariance.has_value());
  EXPECT_NEAR(summary.ml_covariance->mean, 3, 3 * std::sqrt(6.0 / setup.trials))
      << "chi-square's own scatter";
  const Row& ml = summary.methods.back();
  const Row& extended = summary.methods[summary.methods.size() - 2];
  EXPECT_LT(ml.rms[kB_over_S], extended.rms[kB_over_S] / 2);
  EXPECT_LT(ml.rms[kScale], extended.rms[kScale] / 10);
}

TEST(TyresStudy, ReachesTheBoundOfEAndOfTheFactorsWithAnHonestCovariance) {
  TrialSetup setup;
  setup.trials = 60;
  setup.runs = setup.circles = 2;
  setup.side_m = 1;
  setup.e = 0.02;
  setup.noise.K_m = 1e-6;  // so that every trial shows e by far
  const Summary summary = summarize(setup, kRobot, run_study(setup, kRobot, {1, 1}, 1, kSilent));
  EXPECT_TRUE(summary.failures.empty());
  ASSERT_EQ(summary.ml_over_bound.size(), 4U);
  for (const Ratio& ratio : summary.ml_over_bound) {
    std::printf("ml over the bound: %.3f of 1, chance %.3f\n", ratio.value, ratio.se);
    EXPECT_LT(ratio.value, 1.1 + 3 * ratio.se);
    EXPECT_GT(ratio.value, 1 - 3 * ratio.se) << "nobody is better than the bound";
  }
  ASSERT_TRUE(summary.ml_covariance.has_value());
  std::printf("chi-square %.2f of %.2f\n", summary.ml_covariance->mean, summary.ml_covariance->expected);
  EXPECT_EQ(summary.ml_covariance->expected, 4) << "every trial estimates e";
  EXPECT_NEAR(summary.ml_covariance->mean, 4, 3 * summary.ml_covariance->se) << "chi-square's own scatter";
}

TEST(TyresStudy, WhatSpinsWindUpIsTakenNeitherForSlipNorForAnotherWheelbase) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  TrialSetup setup;
  setup.trials = 100;
  setup.runs = 2;
  setup.noise = {5e-7, 2e-4, 5e-4};  // a good floor and a good tracker, which see the wind-up
  setup.windup_rad = 0.006;
  const Summary summary = summarize(setup, kRobot, run_study(setup, kRobot, {1, 1}, 1, kSilent));
  ASSERT_TRUE(summary.ml_median_K_m.has_value());
  const MeanError b_over_S = summary.ml_mean_errors.at(kB_over_S);
  std::printf("b off by %.1e +- %.1e of b, K %.2e m\n", b_over_S.value, b_over_S.se, *summary.ml_median_K_m);
  // With samples within spins, b / S comes out 1.8e-4 too large, which is five of these standard errors.
  EXPECT_LT(std::abs(b_over_S.value), 3 * b_over_S.se);
  EXPECT_LT(*summary.ml_median_K_m, 2 * setup.noise.K_m);
  EXPECT_GT(*summary.ml_median_K_m, setup.noise.K_m / 2);
}

INSTANTIATE_TEST_SUITE_P(Clock, MaximumLikelihoodStudy, testing::Bool(),
                         [](const auto& clock) { return clock.param ? "Known" : "Estimated"; });

}  // namespace
}  // namespace astro::simulation::study
