#include <gtest/gtest.h>

#include "common/kinematics/odometry.hpp"
#include "tests/common/kinematics/near.hpp"

namespace astro {
namespace {

using tests::Real;

constexpr std::int64_t kMetre_61 = std::int64_t{1} << 61;
constexpr std::int64_t kQuarter = std::int64_t{1} << 62;
constexpr std::int64_t kEighth = std::int64_t{1} << 61;

Pose drive(std::int64_t travel, std::int64_t turn, int steps, std::uint64_t theta = 0) {
  ArcIntegrator integrator;
  Pose start;
  start.theta = Angle::from_raw(theta);
  integrator.set_pose(start);
  for (int i = 0; i < steps; ++i) integrator.advance(travel, turn);
  return integrator.pose();
}

tests::ExactPose exact(std::int64_t travel, std::int64_t turn, int steps, std::uint64_t theta = 0) {
  const Real way_m = std::ldexp(static_cast<Real>(travel), -61) * steps;
  const Real turn_rad = 2 * tests::kPi * std::ldexp(static_cast<Real>(turn), -64) * steps;
  return tests::moved({0, 0, tests::radians(theta)}, way_m, turn_rad);
}

TEST(ArcIntegrator, OneStepIsTheArcOfTheClosedForm) {
  tests::Seeded random(1);
  for (int i = 0; i < 100'000; ++i) {
    const std::int64_t travel = random.any_size(62), turn = random.any_size(58);  // 2 m; 1/64 turn
    const std::uint64_t theta = random.bits();
    const Real way_m = std::fabs(std::ldexp(static_cast<Real>(travel), -61));
    ASSERT_LT(tests::distance_m(drive(travel, turn, 1, theta), exact(travel, turn, 1, theta)),
              2e-10L * way_m + tests::kNotYetGiven_m)  // and the way not yet given out
        << travel << " " << turn << " " << theta;
  }
}

TEST(ArcIntegrator, AStepAtTheEdgeOfTheDomainIsGoodToTheSeries) {
  for (const std::int64_t sign : {1, -1})
    for (const std::int64_t way : {4 * (kMetre_61 - 1), -4 * (kMetre_61 - (std::int64_t{1} << 32))})
      EXPECT_LT(tests::distance_m(drive(way, sign * kEighth, 1), exact(way, sign * kEighth, 1)),
                4 * 1.6e-9L + tests::kNotYetGiven_m);  // h^8 / 9!
}

TEST(ArcIntegrator, AFullCircleClosesAndAHalfCircleIsADiameter) {
  constexpr int kSteps = 4096;
  const std::int64_t turn = 4 * (kQuarter / kSteps);
  const std::int64_t travel = kMetre_61 / 1024;  // circumference 4 m
  const Pose half = drive(travel, turn, kSteps / 2);
  EXPECT_PRED_FORMAT3(tests::near, tests::metres(half.x), 0, 1e-9L);
  EXPECT_PRED_FORMAT3(tests::near, tests::metres(half.y), 4 / tests::kPi, 4 * 2e-10L + tests::kNotYetGiven_m);
  const Pose whole = drive(travel, turn, kSteps);
  EXPECT_EQ(whole.theta, Angle{});
  EXPECT_EQ(whole.turns, 1);
  EXPECT_PRED_FORMAT3(tests::near, tests::metres(whole.x), 0, tests::kNotYetGiven_m);
  EXPECT_PRED_FORMAT3(tests::near, tests::metres(whole.y), 0, tests::kNotYetGiven_m);
}

TEST(ArcIntegrator, ASteadyTurnDoesNotDependOnTheSamplingRate) {
  // 1 m and 1/8 turn in 1, 10, 100, ... steps. Each division is exact in heading.
  const std::int64_t turn = (std::int64_t{1} << 61) / 100'000 * 100'000,
                     travel = kMetre_61 / 100'000 * 100'000;
  const tests::ExactPose end = exact(travel, turn, 1);
  for (const int steps : {1, 10, 100, 1000, 10'000, 100'000}) {
    const Pose got = drive(travel / steps, turn / steps, steps);
    EXPECT_LT(tests::distance_m(got, end), 2.5e-10L + tests::kNotYetGiven_m)
        << steps;  // at 1 step the series shows a little
    EXPECT_EQ(got.theta, drive(travel, turn, 1).theta) << steps;
  }
}

TEST(ArcIntegrator, TravelTooShortForAProductIsCarriedNotLost) {
  const Pose got = drive(32'000'001, 0, 1'000'000);  // steps of 14 pm, 14 um in all
  EXPECT_PRED_FORMAT3(tests::near, tests::metres(got.x), std::ldexp(32'000'001e6L, -61),
                      tests::kNotYetGiven_m);
}

TEST(ArcIntegrator, SpinMovesNothing) {
  const Pose got = drive(0, kQuarter / 100, 1000);
  EXPECT_EQ(got.x, 0);
  EXPECT_EQ(got.y, 0);
}

}  // namespace
}  // namespace astro
