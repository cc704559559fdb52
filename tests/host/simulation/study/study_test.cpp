#include "host/simulation/study/study.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "host/calibration/motion/arc.hpp"
#include "host/simulation/study/kinematic_source.hpp"
#include "host/simulation/study/shard_file.hpp"
#include "host/simulation/study/summary.hpp"
#include "tests/host/calibration/end_poses/square_runs.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/thorough.hpp"

namespace astro::simulation::study {
namespace {

using calibration::Trajectory;
using calibration::WheelFactors;

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
  setup.trials = support::how_often(20, 60);
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

/// The same drives fitted with e and without, by sums of squares over the trials.
struct WithAndWithoutE {
  std::array<double, 4> with{},
      without{};          // E_d, b / S, S, and the heading after a turn of a circle of 0.75 m
  double chi_square = 0;  // of four, with e
  int trials = 0;

  void add(const TrialSetup& setup, int trial) {
    const std::vector<Trajectory> runs = kRobot.of_trial(setup, trial).runs;
    calibration::MlOptions options = setup.ml_options();
    const calibration::MlEstimate found = estimate_ml(runs, setup.loaded(), options);
    options.with_e = false;
    add(with, found.factors, setup);
    add(without, estimate_ml(runs, setup.loaded(), options).factors, setup);
    const WheelFactors actual = setup.actual();
    const Eigen::Vector4d error(found.factors.c_r - actual.c_r, found.factors.c_l - actual.c_l,
                                found.factors.b_m - actual.b_m, found.factors.e - actual.e);
    chi_square += error.dot(found.covariance.ldlt().solve(error));
    ++trials;
  }

  static void add(std::array<double, 4>& sums, const WheelFactors& found, const TrialSetup& setup) {
    const Errors errors = errors_of(found, setup);
    constexpr double kTurn_rad = 2 * std::numbers::pi, kRadius_m = 0.75;
    const double outer_m = kTurn_rad * (kRadius_m + setup.wheelbase_m / 2),
                 inner_m = kTurn_rad * (kRadius_m - setup.wheelbase_m / 2);
    const auto heading_rad = [&](const WheelFactors& factors) {
      Pose2 end;
      calibration::advance(end, outer_m, inner_m, factors);
      return end.theta_rad;
    };
    const std::array<double, 4> all{errors[kE_d], errors[kB_over_S], errors[kScale],
                                    heading_rad(found) - heading_rad(setup.actual())};
    for (std::size_t i = 0; i < all.size(); ++i) sums[i] += all[i] * all[i];
  }
};

class PriorOfEStudy : public testing::TestWithParam<int> {};

TEST_P(PriorOfEStudy, LeavesNoRobotWorseOffAndIsHonest) {
  TrialSetup setup;
  setup.trials = support::how_often(20, 300);
  setup.runs = 2;
  setup.circles = GetParam();
  setup.side_m = 1;
  setup.clock_known = false;
  double chi_square = 0;
  int all = 0;
  for (const double e : {0.0, 0.015, 0.03}) {
    setup.e = e;
    WithAndWithoutE sums;
    for (int trial = 0; trial < setup.trials; ++trial) sums.add(setup, trial);
    setup.e = e == 0 ? 1e-9 : e;  // as good as none, but unknown
    const Row bound = bound_of(setup, kRobot);
    const auto rms = [&](double squares) { return std::sqrt(squares / sums.trials); };
    std::printf(
        "e = %.3f, %d trials: over the bound E_d %.3f, b/S %.3f, S %.3f (%.3f, %.3f, %.3f with e = 0); "
        "a circle's heading off by %.1f (%.1f) mrad; chi-square %.2f of 4\n",
        e, sums.trials, rms(sums.with[0]) / bound.rms[kE_d], rms(sums.with[1]) / bound.rms[kB_over_S],
        rms(sums.with[2]) / bound.rms[kScale], rms(sums.without[0]) / bound.rms[kE_d],
        rms(sums.without[1]) / bound.rms[kB_over_S], rms(sums.without[2]) / bound.rms[kScale],
        1e3 * rms(sums.with[3]), 1e3 * rms(sums.without[3]), sums.chi_square / sums.trials);
    const double chance = 3 / std::sqrt(2.0 * sums.trials);
    EXPECT_LT(rms(sums.with[0]) / bound.rms[kE_d], 1.05 + chance);
    EXPECT_LT(rms(sums.with[1]) / bound.rms[kB_over_S], 1.05 + chance);
    EXPECT_LT(rms(sums.with[2]) / bound.rms[kScale], 1.05 + chance);
    // Only a fit that knows that there is none can be better, and only with drives that show e.
    if (e > 0 || setup.circles == 0) {
      for (std::size_t i = 0; i < sums.with.size(); ++i)
        EXPECT_LT(rms(sums.with[i]), 1.02 * rms(sums.without[i])) << i;
    }
    chi_square += sums.chi_square;
    all += sums.trials;
  }
  EXPECT_NEAR(chi_square / all, 4, 3 * std::sqrt(8.0 / all)) << "chi-square's own scatter";
}

INSTANTIATE_TEST_SUITE_P(OfSquaresAloneAndWithCircles, PriorOfEStudy, testing::Values(0, 2),
                         [](const auto& circles) {
                           return circles.param == 0 ? "SquaresAlone" : "WithCircles";
                         });

INSTANTIATE_TEST_SUITE_P(Clock, MaximumLikelihoodStudy, testing::Bool(),
                         [](const auto& clock) { return clock.param ? "Known" : "Estimated"; });

}  // namespace
}  // namespace astro::simulation::study
