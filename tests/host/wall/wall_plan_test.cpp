#include "host/wall/wall_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/host/wall/synthetic_robot.hpp"

namespace astro::wall {
namespace {

using Kind = WallMove::Kind;

int count(const WallCourse& course, Kind kind) {
  return static_cast<int>(
      std::ranges::count_if(course.moves, [&](const WallMove& move) { return move.kind == kind; }));
}

TEST(WallPlan, ReachesItsTargetsInTenMinutes) {
  const WallCourse course = plan_course({}, kNominal);
  EXPECT_LE(course.expected.E_d, 2e-4);
  EXPECT_LE(course.expected.b, 1e-3);
  EXPECT_LE(course.expected.scale, 1e-3);
  EXPECT_LE(course.time_s, 660) << "an estimate: the bar of ten minutes is held on the simulated robot";
  EXPECT_EQ(count(course, Kind::gap), 2);
  EXPECT_EQ(count(course, Kind::spin), 0) << "the laps turn enough";
}

TEST(WallPlan, ErrorsOfALongCourseAreThoseOfTheDesignRules) {
  WallNoise noise;
  noise.squaring_rad = 1e-5;
  const std::vector<WallMove> laps{{Kind::laps, 0.0, 20, 10}, {Kind::laps, 0.0, -20, 10}};
  const WallErrors errors = expected_errors(laps, kNominal, noise);
  // sd(E_d) = sqrt(2 K P / D^2): 800 m forwards, and 36 m of each wheel in turns, which slip but show nothing of E_d.
  EXPECT_NEAR(errors.E_d, std::sqrt(2 * noise.K_m * (800 + 40 * M_PI * 0.29)) / 800, 1e-6);
}

TEST(WallPlan, TakesMoreMovesForMorePrecisionAndForMoreSlip) {
  WallWishes precise, slippery;
  precise.targets.E_d = 1e-4;
  slippery.noise.K_m *= 3;
  const int usual = count(plan_course({}, kNominal), Kind::laps);
  EXPECT_GT(count(plan_course(precise, kNominal), Kind::laps), 3 * usual);
  EXPECT_GT(count(plan_course(slippery, kNominal), Kind::laps), 2 * usual);
}

TEST(WallPlan, TurnsOnTheSpotOnlyIfLapsDoNotShowB) {
  WallWishes wishes;
  wishes.targets = {1e-3, 1e-4};
  const WallCourse course = plan_course(wishes, kNominal);
  EXPECT_GT(count(course, Kind::spin), 0);
  EXPECT_LE(course.expected.b, 1e-4);
}

TEST(WallPlan, TurnsMoreOftenOnTheSpotIfTheFrontLiesBadlyAgainstTheWall) {
  const auto turns = [](double squaring_rad) {
    WallWishes wishes;
    wishes.noise.squaring_rad = squaring_rad;
    return spin_number(0, wishes, kNominal.b_m).turns;
  };
  EXPECT_EQ(turns(WallNoise{}.squaring_rad), 3);
  // With K = 2.645e-6 m and b = 0.29 m slip and squarings are alike after squaring^2 b / (pi K) turns: 6 at 0.013 rad.
  EXPECT_EQ(turns(0.013), 6);
  EXPECT_EQ(turns(0.035), 10) << "longer turns would hardly be better";
  WallWishes loose;
  loose.noise.squaring_rad = 0.0175;
  EXPECT_LE(plan_course(loose, kNominal).expected.b, 1e-3);
}

TEST(WallPlan, BeginsWithShortMovesForARobotThatNobodyHasCalibrated) {
  const WallCourse course = plan_course({}, kNominal);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(course.moves[i].kind, Kind::repeat);
  for (std::size_t i = 3; i < kFirstMoves; ++i) EXPECT_LE(course.moves[i].line_m, 1);
  for (std::size_t i = 0; i < kFirstMoves; ++i) EXPECT_NE(course.moves[i].kind, Kind::gap);
  EXPECT_EQ(course.moves[kFirstMoves].kind, Kind::gap);
  int sum = 0;
  for (const WallMove& move : course.moves) sum += move.turns;
  EXPECT_LE(std::abs(sum), 3) << "about as many turns one way round as the other";
}

TEST(WallPlan, SaysThatTheScaleIsNotKnownWithoutARuler) {
  WallWishes wishes;
  wishes.readings = 0;
  EXPECT_TRUE(std::isnan(plan_course(wishes, kNominal).expected.scale));
}

}  // namespace
}  // namespace astro::wall
