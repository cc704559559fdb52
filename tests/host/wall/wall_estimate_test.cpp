#include "host/wall/wall_estimate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "host/base/text/degrees.hpp"
#include "host/wall/wall_plan.hpp"
#include "tests/host/wall/synthetic_robot.hpp"

namespace astro::wall {
namespace {

using Kind = WallMove::Kind;

WallDrive driven(const calibration::WheelFactors& actual, const WallNoise& noise, std::uint64_t seed,
                 const std::vector<WallMove>& moves, const calibration::WheelFactors& believed = kNominal) {
  SyntheticRobot robot(actual, noise, seed);
  for (const WallMove& move : moves) robot.drive(move, believed);
  return robot.drive_so_far();
}

TEST(WallEstimate, FindsTheFactorsExactlyWithoutNoise) {
  const calibration::WheelFactors actual = factors_with(1.00416, 0.28861, 1.005);
  const WallEstimate found =
      estimate_wall(driven(actual, kNoNoise, 1, plan_course({}, kNominal).moves), kNominal);
  // What is known beforehand pulls by its share of the information: (se / 2 %)^2 of the error for E_d, (se / 5 %)^2 for b.
  EXPECT_NEAR(found.E_d, 1.00416, 0.00416 * 2e-4);
  EXPECT_NEAR(found.b_per_scale_m, 0.28861, 0.0014 * 2e-4);
  ASSERT_TRUE(found.scale.has_value());
  EXPECT_NEAR(found.scale->scale, 1.005, 1e-6);
  EXPECT_NEAR(found.factors.c_r, actual.c_r, 2e-6);
  EXPECT_NEAR(found.factors.c_l, actual.c_l, 2e-6);
  EXPECT_NEAR(found.factors.b_m, actual.b_m, 1e-6);
}

TEST(WallEstimate, DoesNotDependOnWhatTheRobotCarries) {
  const calibration::WheelFactors actual = factors_with(0.997, 0.2914, 0.99),
                                  other = factors_with(1.003, 0.287, 1.01);
  const auto moves = plan_course({}, kNominal).moves;
  const calibration::WheelFactors by_nominal =
      estimate_wall(driven(actual, kNoNoise, 1, moves, kNominal), kNominal).factors;
  const calibration::WheelFactors by_other =
      estimate_wall(driven(actual, kNoNoise, 1, moves, other), other).factors;
  EXPECT_NEAR(by_nominal.c_r, by_other.c_r, 4e-6);
  EXPECT_NEAR(by_nominal.c_l, by_other.c_l, 4e-6);
  EXPECT_NEAR(by_nominal.b_m, by_other.b_m, 2e-6);
}

TEST(WallEstimate, KeepsTheLoadedScaleWithoutARuler) {
  WallWishes wishes;
  wishes.readings = 0;
  const calibration::WheelFactors loaded = factors_with(1, 0.29, 0.98),
                                  actual = factors_with(1.004, 0.288, 1.01);
  const WallEstimate found =
      estimate_wall(driven(actual, kNoNoise, 1, plan_course(wishes, loaded).moves, loaded), loaded);
  EXPECT_FALSE(found.scale.has_value());
  EXPECT_TRUE(std::isnan(found.se.scale));
  EXPECT_NEAR((found.factors.c_r + found.factors.c_l) / 2, 0.98, 1e-12);
  EXPECT_NEAR(found.factors.b_m / 0.98, 0.288, 1e-6);
  EXPECT_NEAR(found.E_d, 1.004, 1e-6);
}

/// Noiseless, with readings that are off by these.
WallScale scale_of(const std::vector<double>& off_m) {
  const calibration::WheelFactors actual = factors_with(1.004, 0.2885, 1.005);
  const std::vector<WallMove> moves(off_m.size(), {Kind::gap, 2, 0, 0});
  WallDrive drive = driven(actual, kNoNoise, 1, moves);
  for (std::size_t i = 0; i < off_m.size(); ++i) drive[0].readings[i].gap_m += off_m[i];
  return scale_of_gaps(drive, actual, {}).value();
}

TEST(WallScale, LeavesOutTheReadingThatTheOthersContradict) {
  for (const std::vector<double>& off_m : std::vector<std::vector<double>>{
           {0.027, 0, 0.001}, {0, -0.027, 0.001}, {0, 0.001, 0.06}, {0, 0.02, 0, -0.03, 0.001}}) {
    const WallScale found = scale_of(off_m);
    EXPECT_EQ(found.readings, off_m.size() == 3 ? 2 : 3);
    EXPECT_NEAR(found.scale, 1.005, 0.0005);
    EXPECT_FALSE(found.contradictory());
  }
}

TEST(WallScale, GrowsItsErrorByWhatTheReadingsScatter) {
  const WallScale agreeing = scale_of({0, 0.002}), apart = scale_of({0, 0.006}),
                  contradictory = scale_of({0, 0.03});
  EXPECT_EQ(agreeing.scatter, 1);
  EXPECT_GT(apart.scatter, 1);
  EXPECT_FALSE(apart.contradictory());
  EXPECT_TRUE(contradictory.contradictory());
  EXPECT_NEAR(contradictory.scale, 1.005 + 0.015 / 2, 1e-4);
  EXPECT_GT(contradictory.se, 0.006) << "each is 15 mm of 2 m from their mean";
  const WallScale three = scale_of({0, 0.03, -0.03});
  EXPECT_EQ(three.left_out, 0) << "none stands out";
  EXPECT_TRUE(three.contradictory());
}

TEST(WallEstimate, CountsManyTurnsAfterOneHasTaughtHowLongTheyAre) {
  // Ten turns with a wheelbase that is 8 % off are 0.8 turns too many: counted by the loaded wheelbase they would be eleven.
  const calibration::WheelFactors actual = factors_with(1, 0.29 * 0.92, 1);
  const std::vector<WallMove> moves{{Kind::spin, 0.4, 1, 0}, {Kind::spin, 0.4, 10, 0}};
  SyntheticRobot robot(actual, kNoNoise, 1);
  for (const WallMove& move : moves) robot.drive(move, kNominal);
  EXPECT_NEAR(estimate_wall(robot.drive_so_far(), kNominal).b_per_scale_m, actual.b_m, 1e-5);
}

TEST(WallEstimate, ALineBackwardsAndForwardsShowsNothingOfE_d) {
  const calibration::WheelFactors actual = factors_with(1.004, 0.29, 1);
  const std::vector<WallMove> there_and_back(20, {Kind::gap, 3, 0, 0});
  EXPECT_GT(estimate_wall(driven(actual, WallNoise{}, 1, there_and_back), kNominal).se.E_d, 0.01);
  std::vector<WallMove> laps;
  for (int i = 0; i < 10; ++i) laps.push_back({Kind::laps, 0.4, i % 2 == 0 ? 1 : -1, 3});
  EXPECT_LT(estimate_wall(driven(actual, WallNoise{}, 1, laps), kNominal).se.E_d, 6e-4);
}

TEST(WallEstimate, KnowsHowFarItIsOff) {
  constexpr int kTrials = 400;
  for (const double times : {0.1, 1.0, 4.0}) {
    WallNoise noise;
    noise.K_m *= times;
    double E_d = 0, b = 0, scale = 0;
    for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
      const calibration::WheelFactors actual = factors_with(1.004, 0.2885, 1.005);
      const WallEstimate found =
          estimate_wall(driven(actual, noise, seed, plan_course({}, kNominal).moves), kNominal);
      E_d += std::pow((found.E_d - 1.004) / found.se.E_d, 2) / kTrials;
      b += std::pow((found.b_per_scale_m / 0.2885 - 1) / found.se.b, 2) / kTrials;
      scale += std::pow((found.scale->scale - 1.005) / found.se.scale, 2) / kTrials;
    }
    std::printf(
        "slip %g times the usual: mean square of error / standard error: E_d %.2f, b %.2f, scale %.2f\n",
        times, E_d, b, scale);
    // K is found from about 20 stretches, and before them it is held to be the usual one within a factor of two.
    for (const double one : {E_d, b, scale}) {
      EXPECT_GT(one, 0.5) << times;
      EXPECT_LT(one, 1.7) << times;
    }
  }
}

// b to 0.1 %, of 400 robots each, whose chi-square scatters by 0.07.
TEST(WallEstimate, KnowsBToATenthOfAPercentWithAFrontThatLiesToADegree) {
  for (const double squaring_deg : {0.5, 1.0}) {
    WallWishes wishes;
    wishes.noise.squaring_rad = radians(squaring_deg);
    constexpr int kTrials = 400;
    double squares = 0, normalised = 0;
    for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
      const calibration::WheelFactors actual = factors_with(1.004, 0.2885, 1.005);
      const WallDrive drive = driven(actual, wishes.noise, seed, plan_course(wishes, kNominal).moves);
      const WallEstimate found = estimate_wall(drive, kNominal, wishes.noise);
      const double error = found.b_per_scale_m / 0.2885 - 1;
      squares += error * error / kTrials;
      normalised += error * error / (found.se.b * found.se.b) / kTrials;
    }
    std::printf("squared to %.1f degrees: rms error of b %.4f %%, chi-square %.2f\n", squaring_deg,
                100 * std::sqrt(squares), normalised);
    EXPECT_LE(std::sqrt(squares), 1e-3);
    EXPECT_GT(normalised, 0.8);
    EXPECT_LT(normalised, 1.25);
  }
}

TEST(WallEstimate, FindsHowMuchWheelsSlipAndHowWellTheRobotSquaresItself) {
  for (const double times : {0.1, 1.0, 10.0}) {
    WallNoise noise;
    noise.K_m *= times;
    double log_K = 0, log_squaring = 0;
    constexpr int kTrials = 40;
    for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
      const WallNoise found =
          estimate_wall(driven(kNominal, noise, seed, plan_course({}, kNominal).moves), kNominal).noise;
      log_K += std::log(found.K_m / noise.K_m) / kTrials;
      log_squaring += std::log(found.squaring_rad / noise.squaring_rad) / kTrials;
    }
    EXPECT_NEAR(log_K, 0, std::log(2)) << times << ": pulled to the usual one";
    EXPECT_NEAR(log_squaring, 0, std::log(2.0)) << times;
  }
}

TEST(WallEstimate, SeriesThatALiftHasPartedCountTogether) {
  const calibration::WheelFactors actual = factors_with(1.004, 0.288, 1.005);
  const auto moves = plan_course({}, kNominal).moves;
  WallDrive drive = driven(actual, WallNoise{}, 1, moves);
  const double alone = estimate_wall(drive, kNominal).se.E_d;
  drive.push_back(driven(actual, WallNoise{}, 2, moves).front());
  EXPECT_NEAR(estimate_wall(drive, kNominal).se.E_d, alone / std::sqrt(2), alone * 0.15)
      << "K differs a little";
}

struct Doubts : testing::Test {
  Doubts() : robot(factors_with(1.004, 0.288, 1), WallNoise{}, 3) {
    for (const WallMove& move : plan_course({}, kNominal).moves) robot.drive(move, kNominal);
    expected = estimate_wall(robot.drive_so_far(), kNominal);
    robot.drive({Kind::laps, 0.4, 2, 3}, kNominal);
  }
  std::optional<SquaringDoubt> doubt(double further_m = 0) {
    return doubt_about_squaring(robot.series(), expected, further_m);
  }

  SyntheticRobot robot;
  WallEstimate expected;
};

TEST_F(Doubts, AboutNothingThatSlipExplains) {
  EXPECT_FALSE(doubt().has_value());
  EXPECT_FALSE(doubt(0.01).has_value());
}

TEST_F(Doubts, AboutNoFrontThatLiesAsBadlyAsItsOwnerSays) {
  WallNoise loose;
  loose.squaring_rad = radians(1.0);
  SyntheticRobot badly(kNominal, loose, 4);
  for (int i = 0; i < 20; ++i) {
    badly.drive({Kind::repeat, 0.08, 0, 0}, kNominal);
    EXPECT_FALSE(doubt_about_squaring(badly.series(), estimate_wall({}, kNominal, loose), 0).has_value());
  }
}

TEST_F(Doubts, AboutARobotThatWasTurnedMeanwhile) {
  robot.series().squarings.back().right_m += 0.29 * 0.4;
  const auto found = doubt();
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->kind, SquaringDoubt::Kind::turned);
  EXPECT_NEAR(found->off, 0.4, 0.1);
  EXPECT_NE(found->fact.find("degrees more than whole turns"), std::string::npos) << found->fact;
}

TEST_F(Doubts, AboutAWallThatIsNotWhereItWas) {
  ASSERT_TRUE(doubt(-0.2).has_value());
  EXPECT_EQ(doubt(-0.2)->kind, SquaringDoubt::Kind::too_early);
  ASSERT_TRUE(doubt(0.2).has_value());
  EXPECT_EQ(doubt(0.2)->kind, SquaringDoubt::Kind::too_late);
  EXPECT_NE(doubt(0.2)->fact.find("200 mm behind"), std::string::npos) << doubt(0.2)->fact;
}

TEST(ApproachMargin, GrowsWithTheWayAndWithWhatIsNotKnownOfTheRobot) {
  const WallEstimate nothing_known = estimate_wall({}, kNominal);
  const WallEstimate known =
      estimate_wall(driven(kNominal, WallNoise{}, 1, plan_course({}, kNominal).moves), kNominal);
  const WheelTravel little{0, 0, 0.08, 0.08}, laps{12, 12, 13, 13};
  EXPECT_LT(approach_margin_m(little, 0.17, known), 0.02);
  EXPECT_GT(approach_margin_m(laps, 0.17, known), approach_margin_m(little, 0.17, known));
  EXPECT_LT(approach_margin_m(laps, 0.17, known), 0.05);
  EXPECT_GT(approach_margin_m(laps, 0.17, nothing_known), 0.2);
}

}  // namespace
}  // namespace astro::wall
