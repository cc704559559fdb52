#include "common/kinematics/odometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/common/kinematics/near.hpp"

namespace astro {
namespace {

using Int128 = __int128;
using tests::Real;

struct Counts {
  std::int32_t left, right;
};

Geometry astro_geometry() { return make_geometry(tests::calibrated_astro()); }

Pose after(const std::vector<Counts>& steps, const Pose& start = {}) {
  Odometry odometry(astro_geometry());
  odometry.set_pose(start);
  for (const Counts& step : steps) odometry.advance(step.left, step.right, {});
  return odometry.pose();
}

std::vector<Counts> random_steps(tests::Seeded& random, std::size_t size, std::int32_t most = 40) {
  std::vector<Counts> steps(size);
  for (Counts& step : steps) step = {random.between32(-most, most), random.between32(-most, most)};
  return steps;
}

Int128 continuous(const Pose& pose) { return (Int128{pose.turns} << 64) + Int128{pose.theta.raw()}; }

TEST(Odometry, HeadingDoesNotDependOnTheOrderOfSteps) {
  tests::Seeded random(1);
  std::vector<Counts> steps = random_steps(random, 10'000);
  const Int128 heading = continuous(after(steps));
  std::sort(steps.begin(), steps.end(), [](const Counts& a, const Counts& b) { return a.left < b.left; });
  EXPECT_TRUE(continuous(after(steps)) == heading);
}

TEST(Odometry, HeadingDoesNotDependOnTheGroupingOfSteps) {
  tests::Seeded random(2);
  const std::vector<Counts> steps = random_steps(random, 10'000);
  std::vector<Counts> grouped;
  for (std::size_t i = 0; i < steps.size();) {
    Counts sum{0, 0};
    for (std::int64_t n = random.between(1, 5); n > 0 && i < steps.size(); --n, ++i) {
      sum.left += steps[i].left;
      sum.right += steps[i].right;
    }
    grouped.push_back(sum);
  }
  EXPECT_TRUE(continuous(after(grouped)) == continuous(after(steps)));
}

TEST(Odometry, HeadingIsIntegerLinearInTheCounts) {
  tests::Seeded random(3);
  const Geometry geometry = astro_geometry();
  Odometry odometry(geometry);
  Int128 expected = 0;
  for (int i = 0; i < 200'000; ++i) {
    const Counts step{random.between32(-900, 900), random.between32(-900, 900)};
    odometry.advance(step.left, step.right, {});
    expected += Int128{geometry.right.turn} * step.right - Int128{geometry.left.turn} * step.left;
    ASSERT_TRUE(continuous(odometry.pose()) == expected) << i;  // through every wrap, in both directions
  }
}

TEST(Odometry, ForwardThenBackwardEndsOnTheVeryHeading) {
  tests::Seeded random(4);
  Pose start;
  start.theta = Angle::from_raw(random.bits());
  std::vector<Counts> steps = random_steps(random, 10'000);
  for (std::size_t i = steps.size(); i-- > 0;) steps.push_back({-steps[i].left, -steps[i].right});
  const Pose end = after(steps, start);
  EXPECT_EQ(end.theta, start.theta);
  EXPECT_EQ(end.turns, start.turns);
}

TEST(Odometry, ContinuousHeadingCrossesPiAndTheFullTurnWithoutAJump) {
  Odometry odometry(astro_geometry());
  for (const int direction : {1, -1, -1, 1}) {
    for (int i = 0; i < 3000; ++i) {  // 3000 ticks of 2 * 10 counts at 0.28 mrad: 2.7 turns
      const Real before = tests::heading_rad(odometry.pose());
      odometry.advance(-10 * direction, 10 * direction, {});
      ASSERT_PRED_FORMAT3(tests::near, tests::heading_rad(odometry.pose()) - before, direction * 0.0056L,
                          0.0001L)
          << i;
    }
  }
  EXPECT_EQ(odometry.pose().turns, 0);
  EXPECT_EQ(odometry.pose().theta, Angle{});
}

TEST(Odometry, FollowsTheExactExponentialOnRandomDrives) {
  tests::Seeded random(5);
  const ParameterSet set = tests::calibrated_astro();
  for (int drive = 0; drive < 20; ++drive) {
    Odometry ours(make_geometry(set));
    tests::ExactOdometry exact(set);
    const std::int32_t most = random.between32(1, 60);
    for (int i = 0; i < 20'000; ++i) {
      const Counts step{random.between32(-most, most), random.between32(-most, most)};
      ours.advance(step.left, step.right, {});
      exact.advance(step.left, step.right);
    }
    // The way's share is what the header states; kNotYetGiven_m is carried, and each of the 4e5
    // count pairs may turn by 2^-64 of a turn less or more, which is nothing.
    EXPECT_LT(tests::distance_m(ours.pose(), exact.pose()), 2e-10L * exact.way_m() + tests::kNotYetGiven_m)
        << most;
    EXPECT_PRED_FORMAT3(tests::near, tests::heading_rad(ours.pose()), exact.pose().theta_rad, 1e-12L);
  }
}

TEST(Odometry, FollowsTheExactExponentialForAnyValidRobot) {
  tests::Seeded random(6);
  for (int robot = 0; robot < 300; ++robot) {
    const ParameterSet set = tests::random_robot(random);
    const Geometry geometry = make_geometry(set);
    // As the robot does: at most a sixteenth of a turn per wheel and tick.
    const std::int64_t turn = std::max(geometry.left.turn, geometry.right.turn);
    const auto most = static_cast<std::int32_t>(std::min<std::int64_t>(1000, (std::int64_t{1} << 60) / turn));
    Odometry ours(geometry);
    tests::ExactOdometry exact(set);
    Real heading_bound = 0;
    for (int i = 0; i < 300; ++i) {
      const Counts step{random.between32(-most, most), random.between32(-most, most)};
      ours.advance(step.left, step.right, {});
      exact.advance(step.left, step.right);
      heading_bound += (std::abs(step.left) + std::abs(step.right)) * tests::radians(1) / 2;
    }
    // Large angles per step show the chord's series to the seventh power: 1.6e-9 of the way at an eighth of a
    // turn.
    ASSERT_LT(tests::distance_m(ours.pose(), exact.pose()), 2e-9L * exact.way_m() + tests::kNotYetGiven_m)
        << robot;
    ASSERT_PRED_FORMAT3(tests::near, tests::heading_rad(ours.pose()), exact.pose().theta_rad,
                        heading_bound + 1e-15L)
        << robot;
  }
}

TEST(Odometry, AStraightLineAtAnAwkwardHeadingKeepsItsWayToTheLastNanometre) {
  // The same step a million times: a rounding error that the step makes, it makes a million times.
  tests::Seeded random(7);
  ParameterSet set;  // both wheels alike: straight
  for (int line = 0; line < 20; ++line) {
    Pose start;
    start.theta = Angle::from_raw(random.bits());
    Odometry ours(make_geometry(set));
    ours.set_pose(start);
    const tests::ExactGeometry geometry(set);
    const int ticks = 200'000;
    for (int i = 0; i < ticks; ++i) ours.advance(1, 1, {});
    const Real way_m = geometry.left_m * ticks;
    const tests::ExactPose exact = tests::moved({0, 0, tests::radians(start.theta.raw())}, way_m, 0);
    EXPECT_LT(tests::distance_m(ours.pose(), exact), 2e-10L * way_m + tests::kNotYetGiven_m)
        << start.theta.raw();
  }
}

TEST(Odometry, SetPoseLeavesNothingOfThePast) {
  tests::Seeded random(8);
  const std::vector<Counts> past = random_steps(random, 1001), future = random_steps(random, 1000);
  Pose start;
  start.x = 12345;
  start.y = -67890;
  start.theta = Angle::from_raw(std::uint64_t{1} << 61);
  start.turns = 3;
  Odometry odometry(astro_geometry());
  for (const Counts& step : past) odometry.advance(step.left, step.right, {});
  odometry.set_pose(start);
  EXPECT_EQ(odometry.pose(), start);
  for (const Counts& step : future) odometry.advance(step.left, step.right, {});
  EXPECT_EQ(odometry.pose(), after(future, start));
}

TEST(Odometry, MovingTheStartMovesThePathWithIt) {
  tests::Seeded random(9);
  const std::vector<Counts> steps = random_steps(random, 1000);
  Pose start;
  start.x = random.any_size(50);
  start.y = random.any_size(50);
  const Pose from_zero = after(steps), moved = after(steps, start);
  EXPECT_EQ(moved.x - start.x, from_zero.x);
  EXPECT_EQ(moved.y - start.y, from_zero.y);
}

TEST(Odometry, ChangingTheGeometryOnTheWayMovesNothingAndThenCounts) {
  ParameterSet other = tests::calibrated_astro();
  other.set(Param::b, 300'000'000);
  other.set(Param::c_L, 1'100'000'000);
  tests::Seeded random(10);
  const std::vector<Counts> past = random_steps(random, 1000), future = random_steps(random, 1000);
  Odometry odometry(astro_geometry());
  for (const Counts& step : past) odometry.advance(step.left, step.right, {});
  const Pose between = odometry.pose();
  odometry.set_geometry(make_geometry(other));
  EXPECT_EQ(odometry.pose(), between);

  tests::ExactOdometry exact(other, tests::heading_rad(between));
  for (const Counts& step : future) {
    odometry.advance(step.left, step.right, {});
    exact.advance(step.left, step.right);
  }
  const Real x_m = tests::metres(between.x) + exact.pose().x_m,
             y_m = tests::metres(between.y) + exact.pose().y_m;
  EXPECT_LT(tests::distance_m(odometry.pose(), {x_m, y_m, 0}),
            2e-10L * exact.way_m() + 2 * tests::kNotYetGiven_m);
  EXPECT_PRED_FORMAT3(tests::near, tests::heading_rad(odometry.pose()), exact.pose().theta_rad, 1e-13L);
}

TEST(Odometry, ChangingTheCurvatureEffectOnTheWayMovesNothingAndThenCounts) {
  ParameterSet set = tests::calibrated_astro();
  const Geometry without = make_geometry(set);
  set.set(Param::e, 32'212'255);  // 0.03
  const Geometry with = make_geometry(set);
  tests::Seeded random(13);
  Odometry odometry(without);
  Int128 expected = 0;
  for (int change = 0; change < 100; ++change) {
    const Geometry& geometry = change % 2 == 0 ? with : without;
    const Pose before = odometry.pose();
    odometry.set_geometry(geometry);
    ASSERT_EQ(odometry.pose(), before);
    expected = continuous(before);
    for (const Counts& step : random_steps(random, 100)) {
      odometry.advance(step.left, step.right, {400'000, 500'000});
      expected += Int128{geometry.right.turn} * step.right - Int128{geometry.left.turn} * step.left;
    }
    // Nothing of e is left where it is 0 again, to the last bit.
    ASSERT_EQ(continuous(odometry.pose()) == expected, !geometry.effective_base.varies()) << change;
  }
}

TEST(Odometry, WithoutACurvatureEffectDoesNotReadTheSpeeds) {
  tests::Seeded random(11);
  Odometry with_speeds(astro_geometry()), without(astro_geometry());
  for (const Counts& step : random_steps(random, 10'000)) {
    with_speeds.advance(
        step.left, step.right,
        {static_cast<std::int32_t>(random.any_size(31)), static_cast<std::int32_t>(random.any_size(31))});
    without.advance(step.left, step.right, {});
  }
  EXPECT_EQ(with_speeds.pose(), without.pose());
}

/// Counts of a wheel at a steady speed.
class Encoder {
 public:
  explicit Encoder(Real counts_per_tick) : per_tick_(counts_per_tick) {}
  std::int32_t next() {
    ++ticks_;
    const auto now = static_cast<std::int64_t>(std::floor(per_tick_ * static_cast<Real>(ticks_)));
    const auto step = static_cast<std::int32_t>(now - seen_);
    seen_ = now;
    return step;
  }
  std::int64_t seen() const { return seen_; }

 private:
  Real per_tick_;
  std::int64_t ticks_ = 0, seen_ = 0;
};

TEST(Odometry, WithACurvatureEffectTurnsAboutTheEffectiveBaseOfTheSpeeds) {
  tests::Seeded random(12);
  for (int drive = 0; drive < 2000; ++drive) {
    ParameterSet set = tests::calibrated_astro();
    tests::draw_effect(set, random);
    const tests::ExactEffect effect(set);
    const tests::ExactGeometry wheels(set);
    // 1 um/s to 67 m/s, any curvature. 67 m/s are 830 counts a tick, less than what the firmware takes for a jump.
    const WheelSpeeds speeds{static_cast<std::int32_t>(random.any_size(26)),
                             static_cast<std::int32_t>(random.any_size(26))};
    Encoder left(speeds.left_umps * 1e-9L / wheels.left_m), right(speeds.right_umps * 1e-9L / wheels.right_m);
    Odometry ours(make_geometry(set));
    constexpr int kTicks = 2000;
    for (int tick = 0; tick < kTicks; ++tick) {
      const std::int32_t left_counts = left.next();
      ours.advance(left_counts, right.next(), speeds);
    }
    const Real about_b_rad =
        (wheels.right_m * static_cast<Real>(right.seen()) - wheels.left_m * static_cast<Real>(left.seen())) /
        wheels.base_m;
    const Real expected_rad = about_b_rad / effect.over_b(speeds.left_umps, speeds.right_umps);
    // What the header states: 5e-5, and what wheel speeds do that are 3 max(1, kappa0) um/s off.
    const Real narrowing = std::fabs(effect.e / (1 + effect.e)),
               off_umps = 3 * std::max<Real>(1, effect.kappa0);
    const Real difference_umps =
        std::max<Real>(1, std::fabs(static_cast<Real>(speeds.right_umps) - speeds.left_umps));
    ASSERT_PRED_FORMAT3(tests::near, tests::heading_rad(ours.pose()), expected_rad,
                        narrowing * std::fabs(about_b_rad) * (5e-5L + off_umps / difference_umps) + 1e-12L)
        << speeds.left_umps << " " << speeds.right_umps << " e " << static_cast<double>(effect.e)
        << " kappa0 " << static_cast<double>(effect.kappa0);
  }
}

TEST(Odometry, ASpinTurnsAboutBWhateverTheCurvatureEffect) {
  for (const double e : {-0.2, 0.03, 0.2}) {
    ParameterSet set = tests::calibrated_astro();
    set.set(Param::e, static_cast<std::int32_t>(std::lround(std::ldexp(e, 30))));
    Odometry with_effect(make_geometry(set)), without(astro_geometry());
    for (int i = 0; i < 1000; ++i) {
      with_effect.advance(-7, 7, {-500'000, 500'000});
      without.advance(-7, 7, {-500'000, 500'000});
    }
    EXPECT_EQ(with_effect.pose(), without.pose()) << e;
  }
}

TEST(Odometry, WhatAStepRoundsWithACurvatureEffectDoesNotAddUp) {
  // A robot whose counts are the finest there are: 2^-64 turn is what a step can lose, of 2^30 of them or more.
  ParameterSet set = tests::calibrated_astro();
  set.set(Param::e, 1 << 25);
  Odometry coarse(make_geometry(set)), fine(make_geometry(set));
  const WheelSpeeds speeds{400'000, 600'000};
  for (int i = 0; i < 1000; ++i) {
    coarse.advance(100, 150, speeds);
    for (int j = 0; j < 50; ++j) fine.advance(2, 3, speeds);
  }
  EXPECT_PRED_FORMAT3(tests::near, tests::heading_rad(fine.pose()), tests::heading_rad(coarse.pose()),
                      50'000 * tests::radians(1));
}

}  // namespace
}  // namespace astro
