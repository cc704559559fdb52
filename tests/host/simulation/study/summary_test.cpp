#include "host/simulation/study/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/calibration/judgement/precision.hpp"
#include "host/simulation/study/kinematic_source.hpp"

namespace astro::simulation::study {
namespace {

Errors all(double value) {
  Errors errors;
  errors.fill(value);
  return errors;
}

TEST(StudyRow, IsTheRootMeanSquareWithItsStandardError) {
  // Squares 9 and 16: mean 12.5, standard error of the mean 3.5.
  const Row row = row_of("known", {all(3), all(-4)});
  EXPECT_EQ(row.trials, 2);
  for (std::size_t f = 0; f < kFigures; ++f) {
    EXPECT_DOUBLE_EQ(row.rms[f], std::sqrt(12.5));
    EXPECT_DOUBLE_EQ(row.se[f], 3.5 / (2 * std::sqrt(12.5)));
  }
}

TEST(StudyRow, OfEqualErrorsHasNoScatter) {
  const Row row = row_of("constant", {all(0.5), all(-0.5), all(0.5)});
  EXPECT_DOUBLE_EQ(row.rms[kE_d], 0.5);
  EXPECT_DOUBLE_EQ(row.se[kE_d], 0);
}

TEST(StudyBound, OfTenSquaresIsThatOfTheDesignRules) {
  const TrialSetup setup;
  const Row bound = bound_of(setup, KinematicSource());
  const calibration::Precision rule = calibration::reachable_precision(
      {10 * 4 * setup.side_m, 10 * 2 * std::numbers::pi}, setup.noise.K_m, setup.wheelbase_m);
  EXPECT_NEAR(bound.rms[kE_d] / rule.E_d, 1, 0.04);  // what precision.hpp promises
  EXPECT_NEAR(bound.rms[kScale] / rule.scale, 1, 0.04);
  EXPECT_NEAR(bound.rms[kB_over_S] / rule.b, 1, 0.04);
  // Published with three digits; here the lever arm is unknown, which removes the information of spins about
  // E_d.
  EXPECT_NEAR(bound.rms[kE_max_m] / 21.6e-3, 1, 0.04);
  EXPECT_NEAR(bound.rms[kTheta_rad] / 8.8e-3, 1, 0.04);
  EXPECT_NEAR(bound.rms[kLine_m] / 35.0e-3, 1, 0.04);
}

TrialSetup small_setup() {
  TrialSetup setup;
  setup.runs = 1;
  setup.side_m = 1;
  return setup;
}

TEST(StudySummary, CountsFailuresInsteadOfHidingThem) {
  Trial good, bad;
  good.errors.fill(all(1e-3));
  good.ml_chi_square = 2;
  bad = good;
  bad.index = 1;
  bad.errors[kMl].reset();
  bad.ml_chi_square.reset();
  bad.failure = "ml: run 1 is too short";
  const Summary summary = summarize(small_setup(), KinematicSource(), {good, bad});
  EXPECT_EQ(summary.methods.front().trials, 2);
  EXPECT_EQ(summary.methods.back().name, "ml");
  EXPECT_EQ(summary.methods.back().trials, 1);
  ASSERT_EQ(summary.failures.size(), 1U);
  EXPECT_EQ(summary.failures[0], "ml gave no answer in 1 of 2 trials, as in trial 1: run 1 is too short");
  ASSERT_TRUE(summary.ml_covariance.has_value());
  EXPECT_EQ(summary.ml_covariance->mean, 2);
  EXPECT_EQ(summary.ml_covariance->trials, 1);
}

TEST(StudySummary, ExpectsAsMuchOfTheCovarianceAsItHasUnknowns) {
  Trial three, four;
  three.errors.fill(all(1e-3));
  three.ml_chi_square = 3;
  three.ml_K_m = 1e-6;
  four = three;
  four.index = 1;
  four.ml_chi_square = 5;
  four.ml_unknowns = 4;
  four.ml_K_m = 3e-6;
  const Summary summary = summarize(small_setup(), KinematicSource(), {three, four, four});
  ASSERT_TRUE(summary.ml_covariance.has_value());
  EXPECT_DOUBLE_EQ(summary.ml_covariance->mean, 13.0 / 3);
  EXPECT_DOUBLE_EQ(summary.ml_covariance->expected, 11.0 / 3);
  // The variance of a chi-square is twice its degrees of freedom.
  EXPECT_DOUBLE_EQ(summary.ml_covariance->se, std::sqrt(2 * 11.0) / 3);
  EXPECT_EQ(summary.ml_median_K_m, 3e-6);
}

TEST(StudySummary, SetsEBesideTheBoundIfTheRobotHasOne) {
  Trial one;
  one.errors.fill(all(1e-3));
  TrialSetup setup = small_setup();
  setup.circles = 1;
  EXPECT_EQ(summarize(setup, KinematicSource(), {one}).bound.rms[kCurvature], 0) << "none, and that is known";
  setup.e = 0.02;
  const Summary summary = summarize(setup, KinematicSource(), {one});
  ASSERT_EQ(summary.ml_over_bound.size(), 4U);
  EXPECT_DOUBLE_EQ(summary.ml_over_bound[kCurvature].value, 1e-3 / summary.bound.rms[kCurvature]);
  EXPECT_EQ(summary.bound.se[kCurvature], 0);
}

TEST(StudySummary, SetsMaximumLikelihoodBesideTheBound) {
  Trial one;
  one.errors.fill(all(1e-3));
  const Summary summary = summarize(small_setup(), KinematicSource(), {one});
  ASSERT_EQ(summary.ml_over_bound.size(), 3U);
  for (const Figure f : {kE_d, kB_over_S, kScale})
    EXPECT_DOUBLE_EQ(summary.ml_over_bound[f].value, 1e-3 / summary.bound.rms[f]);
}

TEST(StudySummary, TellsABiasOfMaximumLikelihoodFromItsScatter) {
  Trial more, less;
  more.errors.fill(all(3e-3));
  less.errors.fill(all(-1e-3));
  const Summary summary = summarize(small_setup(), KinematicSource(), {more, less});
  ASSERT_EQ(summary.ml_mean_errors.size(), 3U);
  for (const MeanError& mean : summary.ml_mean_errors) {
    EXPECT_DOUBLE_EQ(mean.value, 1e-3);
    EXPECT_DOUBLE_EQ(mean.se, 2e-3)
        << "two answers 4e-3 apart: their scatter is 4e-3 / root 2, that of their mean half of 4e-3";
  }
}

TEST(StudySummary, WithoutAnAnswerOfMaximumLikelihoodHasNoRatio) {
  Trial one;
  one.errors[0] = all(1e-3);
  const Summary summary = summarize(small_setup(), KinematicSource(), {one});
  EXPECT_TRUE(summary.ml_over_bound.empty());
  EXPECT_TRUE(summary.ml_mean_errors.empty());
  EXPECT_FALSE(summary.ml_covariance.has_value());
}

}  // namespace
}  // namespace astro::simulation::study
