#include "host/wall/wall_judgement.hpp"

#include <gtest/gtest.h>

#include "tests/host/wall/synthetic_robot.hpp"

namespace astro::wall {
namespace {

WallJudgement judged(const calibration::WheelFactors& actual, const calibration::WheelFactors& loaded,
                     std::uint64_t seed) {
  SyntheticRobot robot(actual, WallNoise{}, seed);
  for (const WallMove& move : plan_course({}, loaded).moves) robot.drive(move, loaded);
  return judge_wall(robot.drive_so_far(), estimate_wall(robot.drive_so_far(), loaded), loaded);
}

TEST(WallJudgement, FindsFactorsBetterThatAreHalfAPercentFromTheLoadedOnes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const WallJudgement judgement = judged(factors_with(1.005, 0.2885, 1.005), kNominal, seed);
    EXPECT_EQ(judgement.verdict, calibration::Verdict::better) << seed;
    EXPECT_LT(judgement.found_rad, judgement.loaded_rad);
    EXPECT_GT(judgement.better_on, judgement.stretches / 2);
    EXPECT_EQ(judgement.sentence().rfind("Better: on ", 0), 0U) << judgement.sentence();
  }
}

TEST(WallJudgement, SeldomFindsFactorsBetterWhereTheLoadedOnesAreRight) {
  int better = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
    better += judged(kNominal, kNominal, seed).verdict == calibration::Verdict::better ? 1 : 0;
  EXPECT_LE(better, 6) << "judge_gains: below 1.5 %; of 100, five standard deviations more";
}

TEST(WallJudgement, SeesAnotherScaleInTheGaps) {
  const WallJudgement judgement = judged(factors_with(1, 0.29, 1.02), kNominal, 1);
  EXPECT_EQ(judgement.verdict, calibration::Verdict::better) << judgement.sentence();
}

/// Of a robot whose scale alone is 1 % off, with this many readings, of which the first is 25 mm off.
WallJudgement judged_with_a_wrong_gap(int readings) {
  WallWishes wishes;
  wishes.readings = readings;
  const calibration::WheelFactors actual = factors_with(1, 0.29, 1.01);
  SyntheticRobot robot(actual, WallNoise{}, 3);
  for (const WallMove& move : plan_course(wishes, kNominal).moves) robot.drive(move, kNominal);
  WallDrive drive = robot.drive_so_far();
  drive[0].readings[0].gap_m += 0.025;
  return judge_wall(drive, estimate_wall(drive, kNominal), kNominal);
}

TEST(WallJudgement, JudgesTheScaleByTheReadingsThatAgree) {
  EXPECT_EQ(judged_with_a_wrong_gap(3).verdict, calibration::Verdict::better);
  EXPECT_FALSE(judged_with_a_wrong_gap(3).readings_contradict);
  EXPECT_NE(judged_with_a_wrong_gap(2).verdict, calibration::Verdict::better);
  EXPECT_TRUE(judged_with_a_wrong_gap(2).readings_contradict);
}

TEST(WallJudgement, CallsNothingWorseOfWhichTwoLapsAreAllThatIsKnown) {
  // Each way round alone does not tell unequal wheels from another wheelbase.
  WallWishes wishes;
  wishes.targets = {0.1, 0.1};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const calibration::WheelFactors actual = factors_with(1.03, 0.2885, 1);
    SyntheticRobot robot(actual, WallNoise{}, seed);
    for (const WallMove& move : plan_course(wishes, kNominal).moves) robot.drive(move, kNominal);
    const WallJudgement judgement =
        judge_wall(robot.drive_so_far(), estimate_wall(robot.drive_so_far(), kNominal), kNominal);
    EXPECT_EQ(judgement.verdict, calibration::Verdict::unknown) << seed << ": " << judgement.sentence();
  }
}

TEST(WallJudgement, SaysThatItKnowsTooLittle) {
  const WallJudgement judgement = judge_wall({}, estimate_wall({}, kNominal), kNominal);
  EXPECT_EQ(judgement.verdict, calibration::Verdict::unknown);
  EXPECT_EQ(judgement.sentence(), "Too few ways were driven to judge the new factors.");
}

}  // namespace
}  // namespace astro::wall
