#include "host/calibration/judgement/cross_validation.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "host/calibration/end_poses/replay.hpp"
#include "host/calibration/judgement/end_pose_validation.hpp"
#include "host/calibration/judgement/remarks.hpp"
#include "tests/host/calibration/ml_drives.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::calibration {
namespace {

using simulation::study::DriveModel;

MlOptions known_clock() {
  MlOptions options;
  options.clock_known = true;
  return options;
}

TEST(Gains, OfOneDriveSayNothing) {
  EXPECT_EQ(judge_gains({}), Verdict::unknown);
  EXPECT_EQ(judge_gains(std::vector{1e6}), Verdict::unknown);
}

TEST(Gains, ThatAreLargeOnBothOfTwoDrivesAreEnough) {
  EXPECT_EQ(judge_gains(std::vector{20.0, 40.0}), Verdict::better);
  EXPECT_EQ(judge_gains(std::vector{-20.0, -40.0}), Verdict::worse);
}

TEST(Gains, ThatContradictEachOtherAreNoVerdictHoweverLargeTheyAre) {
  EXPECT_EQ(judge_gains(std::vector{5e3, -4e3, 6e3, -3e3}), Verdict::undecided);
}

TEST(Gains, ThatAreAsSmallAsChanceMakesThemAreNoVerdict) {
  EXPECT_EQ(judge_gains(std::vector{1.0, 0.5, 0.8, 1.2}), Verdict::undecided);
}

TEST(Gains, OfNothingAreNoImprovement) {
  EXPECT_EQ(judge_gains(std::vector{0.0, 0.0}), Verdict::undecided);
  EXPECT_EQ(judge_gains(std::vector{0.0}), Verdict::unknown);
}

/// A robot whose factors in use are off by `wrong` in one of the ways that matter.
enum class Wrong { ratio, scale, wheelbase };
WheelFactors off_by(const WheelFactors& right, Wrong what, double wrong) {
  switch (what) {
    case Wrong::ratio:
      return {right.c_r * (1 + wrong / 2), right.c_l * (1 - wrong / 2), right.b_m};
    case Wrong::scale:
      return {right.c_r * (1 + wrong), right.c_l * (1 + wrong), right.b_m};
    case Wrong::wheelbase:
      break;
  }
  return {right.c_r, right.c_l, right.b_m * (1 + wrong)};
}

Verdict verdict_on(const DriveModel& model, const WheelFactors& in_use, int runs, std::uint64_t seed) {
  const MlOptions options = known_clock();
  const std::vector<Trajectory> drives = squares(model, runs, 3, seed);
  const MlEstimate all = estimate_ml(drives, in_use, options);
  return cross_validate(drives, in_use, all, options).verdict;
}

// 95 % of the days are within 3.08 standard deviations in four directions.
TEST(CrossValidation, CallsNothingBetterThatDiffersByLessThanRobotsDoFromDayToDay) {
  const DriveModel model = quiet_drive();
  const std::vector<Trajectory> drives = varied_drives(model);
  const auto judged = [&](Wrong what, double wrong) {
    const WheelFactors in_use = off_by(model.actual, what, wrong);
    return cross_validate(drives, in_use, estimate_ml(drives, in_use, known_clock()), known_clock());
  };
  for (const Wrong what : {Wrong::ratio, Wrong::scale, Wrong::wheelbase}) {
    const DayDrift drift;
    double limit = 3.08 * (what == Wrong::ratio ? drift.E_d : drift.b_over_scale);
    if (what == Wrong::scale) limit /= std::sqrt(2);  // of S and, because b stays, of b / S
    const CrossValidation within = judged(what, 0.9 * limit), beyond = judged(what, 1.1 * limit);
    EXPECT_EQ(within.verdict, Verdict::undecided);
    EXPECT_TRUE(within.little_to_gain());
    EXPECT_EQ(beyond.verdict, Verdict::better);
    EXPECT_FALSE(beyond.within_drift);
  }
}

// Three directions are left then, and 95 % of the days are within 2.80 standard deviations.
TEST(CrossValidation, DoesNotCountAScaleThatNobodyKnowsAmongWhatMayHaveDrifted) {
  const DriveModel model = quiet_drive();
  const std::vector<Trajectory> drives = varied_drives(model);
  const WheelFactors in_use = off_by(model.actual, Wrong::ratio, 2.93 * DayDrift().E_d);
  const MlEstimate all = estimate_ml(drives, in_use, known_clock());
  EXPECT_EQ(cross_validate(drives, in_use, all, known_clock(), true).verdict, Verdict::undecided);
  EXPECT_EQ(cross_validate(drives, in_use, all, known_clock(), false).verdict, Verdict::better);
}

// The standard deviation of the drift is 1, and both the factors in use and those found have the drives' own error.
TEST(CrossValidation, CallsItLittleToGainOnlyWhereTheDriftAloneExplainsTheChange) {
  const auto judged = [](double change, double own) {
    CrossValidation out;
    out.verdict = Verdict::better;
    out.weigh_against_drift(Eigen::VectorXd::Constant(1, change), Eigen::MatrixXd::Constant(1, 1, own * own),
                            Eigen::MatrixXd::Constant(1, 1, own * own + 1));
    return out;
  };
  EXPECT_EQ(judged(3, 0.1).verdict, Verdict::better);
  EXPECT_TRUE(judged(1.9, 0.1).within_drift);
  const CrossValidation uncertain = judged(3, 2);
  EXPECT_EQ(uncertain.verdict, Verdict::undecided);
  EXPECT_TRUE(uncertain.within_errors_and_drift);
  EXPECT_FALSE(uncertain.little_to_gain());
}

// Whoever drives more then finds again that there is little to gain.
TEST(CrossValidation, AsksForMoreDrivesOnlyWhereTheyMayShowMoreThanADrift) {
  const auto judged = [](double change, double own) {
    CrossValidation out;
    out.runs.resize(4);
    for (std::size_t i = 0; i < 4; ++i) {
      out.runs[i].gain = i % 2 == 0 ? 2 : -1;
      out.runs[i].claimed = 3;  // 12 together: significant, but drives as few as these need not show it
    }
    out.judge();
    EXPECT_EQ(out.verdict, Verdict::unknown);
    out.weigh_against_drift(Eigen::VectorXd::Constant(1, change), Eigen::MatrixXd::Constant(1, 1, own * own),
                            Eigen::MatrixXd::Constant(1, 1, own * own + 1));
    return out;
  };
  const CrossValidation within = judged(1.9, 0.1);
  EXPECT_EQ(within.verdict, Verdict::undecided);
  EXPECT_TRUE(within.within_drift);
  EXPECT_TRUE(within.not_judged.empty());
  for (const CrossValidation& open : {judged(3, 0.1), judged(3, 2)}) {
    EXPECT_EQ(open.verdict, Verdict::unknown);
    ASSERT_EQ(open.not_judged.size(), 1U);
    EXPECT_EQ(open.not_judged[0].kind, JudgementProblem::too_few_drives);
  }
}

// The lever arm of a session is not known without its only drive, so it is fitted to that drive.
TEST(CrossValidation, HoldsOutTheOnlyDriveOfASession) {
  DriveModel model = astro_drive();
  std::vector<Trajectory> drives = squares(model, 2);
  model.lever = {-0.05, 0.04, -1};
  drives.push_back(squares(model, 3)[2]);
  for (std::size_t i = 0; i < drives.size(); ++i) drives[i].session = i < 2 ? "first day" : "second day";
  for (int order = 0; order < 2; ++order) {
    const MlEstimate all = estimate_ml(drives, model.loaded, known_clock());
    const CrossValidation judged = cross_validate(drives, model.loaded, all, known_clock());
    EXPECT_EQ(judged.runs.size(), 3U);
    EXPECT_EQ(judged.verdict, Verdict::better);
    std::rotate(drives.begin(), drives.begin() + 2, drives.end());
  }
}

/// The robot under a slower tracker, because hundreds of drives are calibrated ten times each. Slip decides how much
/// factors are worth, and it is the same.
DriveModel slow_tracker() {
  DriveModel model = astro_drive();
  model.truth_rate_hz = 10;
  model.count_rate_hz = 20;
  return model;
}

class CrossValidationOf : public testing::TestWithParam<int> {};

TEST_P(CrossValidationOf, RobotsWhoseFactorsAreRightClaimsNoImprovement) {
  const DriveModel model = slow_tracker();
  int claims = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
    claims += verdict_on(model, model.actual, GetParam(), seed) == Verdict::better;
  std::printf("%d runs, seeds 1 to 40: an improvement that is none is claimed of %d robots of 40\n",
              GetParam(), claims);
  EXPECT_LE(claims, 2);  // 5 %
}

INSTANTIATE_TEST_SUITE_P(Runs, CrossValidationOf, testing::Values(2, 10));

class CrossValidationWith : public testing::TestWithParam<Wrong> {};

TEST_P(CrossValidationWith, ThreePerMilleOffInOneRespectRecommendsTheNewFactors) {
  const DriveModel model = slow_tracker();
  int recommended = 0;
  for (std::uint64_t seed = 101; seed <= 114; ++seed) {
    const double wrong = seed % 2 == 0 ? 0.003 : -0.003;
    recommended += verdict_on(model, off_by(model.actual, GetParam(), wrong), 10, seed) == Verdict::better;
  }
  std::printf("seeds 101 to 114: recommended for %d robots of 14\n", recommended);
  EXPECT_EQ(recommended, 14);
}

INSTANTIATE_TEST_SUITE_P(Factors, CrossValidationWith,
                         testing::Values(Wrong::ratio, Wrong::scale, Wrong::wheelbase));

/// What a tape measures after squares of a robot that drives by `in_use`.
CrossValidation judged_by_ends(const WheelFactors& in_use, int squares_each, std::uint64_t seed) {
  DriveModel model = astro_drive();
  model.loaded = in_use;
  model.lever = {};
  std::vector<EndPose> ends[2];
  for (int i = 0; i < 2 * squares_each; ++i) {
    const Sense sense = i % 2 == 0 ? Sense::cw : Sense::ccw;
    ends[i % 2].push_back(simulation::study::end_error(
        simulation::study::synthetic_drive(
            simulation::study::square_course(3, sense), model, "square",
            simulation::study::derived_seed(seed, static_cast<std::uint64_t>(i))),
        in_use));
  }
  return cross_validate(ends[0], ends[1], 3, in_use, Options{Method::extended});
}

TEST(CrossValidationByEnds, OfRobotsWhoseFactorsAreRightClaimsNoImprovement) {
  int claims = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
    claims += judged_by_ends(astro_drive().actual, 5, seed).verdict == Verdict::better;
  std::printf("seeds 1 to 40: an improvement that is none is claimed of %d robots of 40\n", claims);
  EXPECT_LE(claims, 2);  // 5 %
}

TEST(CrossValidationByEnds, OfRobotsWhoseWheelsDifferByThreePerMilleRecommendsTheNewFactors) {
  int recommended = 0;
  for (std::uint64_t seed = 101; seed <= 140; ++seed)
    recommended +=
        judged_by_ends(off_by(astro_drive().actual, Wrong::ratio, seed % 2 == 0 ? 0.003 : -0.003), 5, seed)
            .verdict == Verdict::better;
  std::printf("seeds 101 to 140: recommended for %d robots of 40\n", recommended);
  EXPECT_EQ(recommended, 40);
}

TEST(CrossValidationByEnds, OfOneSquareInADirectionSaysNothing) {
  EXPECT_EQ(judged_by_ends(astro_drive().loaded, 1, kSeed).verdict, Verdict::unknown);
}

TEST(CrossValidationByEnds, BearsAHeadingThatWasNotMeasured) {
  const WheelFactors in_use{1, 1, 0.29}, right{1.002, 0.998, 0.289};
  const auto ends = [&](Sense sense) {
    std::vector<EndPose> list;
    for (const double scatter_m : {-0.01, 0.0, 0.01}) {
      EndPose end = replay_square(3, sense, in_use, right);
      end.x_m += scatter_m;
      end.y_m -= scatter_m;
      if (scatter_m != 0) end.theta_rad = std::nan("");
      list.push_back(end);
    }
    return list;
  };
  const CrossValidation judged =
      cross_validate(ends(Sense::cw), ends(Sense::ccw), 3, in_use, Options{Method::least_squares});
  EXPECT_EQ(judged.verdict, Verdict::better);
  EXPECT_LT(judged.found().final_m, judged.in_use().final_m / 5);
}

TEST(CrossValidation, ClaimsNoImprovementFromDrivesThatContradictEachOther) {
  // The tracker was calibrated anew between the runs, and its metre changed by 4 %.
  const DriveModel model = astro_drive();
  std::vector<Trajectory> drives = squares(model, 4);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const double stretch = i < 2 ? 1.02 : 0.98;
    for (BodySample& sample : drives[i].truth) {
      sample.x_m *= stretch;
      sample.y_m *= stretch;
    }
  }
  const MlOptions options = known_clock();
  const MlEstimate all = estimate_ml(drives, model.actual, options);
  EXPECT_NE(cross_validate(drives, model.actual, all, options).verdict, Verdict::better);
}

TEST(CrossValidation, ShowsTheErrorsOfEachDriveWithFactorsThatHaveNotSeenIt) {
  const DriveModel model = astro_drive();
  const MlOptions options = known_clock();
  const std::vector<Trajectory> drives = squares(model, 4);
  const MlEstimate all = estimate_ml(drives, model.loaded, options);
  const CrossValidation judged = cross_validate(drives, model.loaded, all, options);
  ASSERT_EQ(judged.runs.size(), 4u);
  EXPECT_EQ(judged.better_on(), 4);
  EXPECT_TRUE(judged.not_judged.empty());
  const PathErrors in_use = path_errors(drives, model.loaded, options);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(judged.runs[i].in_use.name, drives[i].name);
    EXPECT_LT(judged.runs[i].found.path_rms_m, judged.runs[i].in_use.path_rms_m);
    // With the lever arm of this run alone or of all: a tenth.
    EXPECT_NEAR(judged.runs[i].in_use.path_rms_m, in_use.runs[i].path_rms_m, 0.1 * in_use.runs[i].path_rms_m);
  }
}

/// How far two sets of factors are apart, in standard errors of each.
double apart(const WheelFactors& a, const WheelFactors& b, const MlErrors& se) {
  return std::max(
      {std::abs(a.c_r - b.c_r) / se.c_r, std::abs(a.c_l - b.c_l) / se.c_l, std::abs(a.b_m - b.b_m) / se.b_m});
}

TEST(CrossValidation, JudgesByFactorsThatAWholeEstimateWithoutTheDriveWouldFind) {
  const DriveModel model = astro_drive();
  const MlOptions options = known_clock();
  for (const int runs : {2, 3, 6}) {
    const std::vector<Trajectory> drives = squares(model, runs);
    const MlEstimate all = estimate_ml(drives, model.loaded, options);
    const CrossValidation judged = cross_validate(drives, model.loaded, all, options);
    ASSERT_EQ(judged.runs.size(), drives.size());
    MlOptions with_noise = options;
    with_noise.noise = all.noise;
    with_noise.spacing_m = all.spacing_m;
    with_noise.widening = all.widening;
    double worst = 0;
    for (std::size_t i = 0; i < drives.size(); ++i) {
      std::vector<Trajectory> others = drives;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const MlEstimate whole = estimate_ml(others, model.loaded, with_noise);
      worst = std::max(worst, apart(judged.runs[i].without_it, whole.factors, whole.se));
    }
    std::printf("%d drives: at most %.3f standard errors apart\n", runs, worst);
    // Where a search ends within a twentieth of a standard error of the best, one step cannot be nearer.
    EXPECT_LT(worst, 0.05);
  }
}

TEST(CrossValidation, NamesWhatCannotBeHeldOut) {
  // A line and a spin: neither alone determines all three factors.
  const DriveModel model = astro_drive();
  const std::vector<Trajectory> drives{
      simulation::study::synthetic_drive(simulation::study::line_course(3), model, "the line", kSeed),
      simulation::study::synthetic_drive(simulation::study::spin_course(6.28), model, "the spin", kSeed + 1)};
  const MlOptions options = known_clock();
  const MlEstimate all = estimate_ml(drives, model.loaded, options);
  const CrossValidation judged = cross_validate(drives, model.loaded, all, options);
  EXPECT_EQ(judged.verdict, Verdict::unknown);
  using Problem = JudgementProblem;
  EXPECT_THAT(judged.not_judged,
              testing::UnorderedElementsAre(support::Tells(Problem::known_by_these_alone, "the line"),
                                            support::Tells(Problem::known_by_these_alone, "the spin")));
}

TEST(CrossValidation, IsNotBetterOnWhatWasNotHeldOut) {
  // The wheelbase comes from the spin alone, and nothing says whether it slipped there.
  const DriveModel model = astro_drive();
  std::vector<Trajectory> drives{
      simulation::study::synthetic_drive(simulation::study::spin_course(6.28), model, "the spin", kSeed)};
  for (unsigned i = 1; i <= 4; ++i)
    drives.push_back(simulation::study::synthetic_drive(simulation::study::line_course(3), model,
                                                        "line " + std::to_string(i), kSeed + i));
  const MlOptions options = known_clock();
  const MlEstimate all = estimate_ml(drives, model.loaded, options);
  const CrossValidation judged = cross_validate(drives, model.loaded, all, options);
  EXPECT_EQ(judged.better_on(), 4);
  EXPECT_EQ(judged.verdict, Verdict::unknown);
  ASSERT_EQ(judged.not_judged.size(), 1u);
}

/// What three measured lines say of a robot that carries a scale of 1, and whose squares say nothing.
CrossValidation judged_by_lines(const std::vector<double>& lengths_m) {
  std::vector<LineEnd> lines;
  for (const double length_m : lengths_m) lines.push_back({length_m, 0, 3, 1});
  CrossValidation judged;
  cross_validate_scale(lines, {1, 1, 0.3}, scale_of_lines(lines).value(), judged);
  return judged;
}

TEST(CrossValidation, HoldsOutMeasuredLines) {
  EXPECT_EQ(judged_by_lines({3.031, 3.029, 3.030}).verdict, Verdict::better)
      << "1 % longer than odometry says";
  EXPECT_NE(judged_by_lines({3.001, 2.998, 3.000}).verdict, Verdict::better) << "as long as odometry says";
  EXPECT_NE(judged_by_lines({3.060, 3.000, 3.001}).verdict, Verdict::better) << "one mistyped";
  const CrossValidation single = judged_by_lines({3.06});
  EXPECT_EQ(single.verdict, Verdict::unknown);
  EXPECT_THAT(single.not_judged, testing::ElementsAre(support::Tells(JudgementProblem::single_line)));
}

}  // namespace
}  // namespace astro::calibration
