#include "hal/sim/chassis.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/hal/sim/support.hpp"

namespace astro::sim {
namespace {

constexpr double kB_m = 0.290;

// Wheel travels of an arc with the given radius and angle.
void arc(Chassis& chassis, double radius_m, double angle_rad) {
  chassis.advance((radius_m - kB_m / 2.0) * angle_rad, (radius_m + kB_m / 2.0) * angle_rad);
}

// 1e-12: a few thousand roundings of numbers near 1.
void expect_pose(const Pose& pose, double x_m, double y_m, double theta_rad, double tolerance = 1e-12) {
  EXPECT_NEAR(pose.x_m, x_m, tolerance);
  EXPECT_NEAR(pose.y_m, y_m, tolerance);
  EXPECT_NEAR(pose.theta_rad, theta_rad, tolerance);
}

TEST(Chassis, ArcsAreExactAtAnyStepSize) {
  for (const double radius_m : {0.0, 0.145, 0.5, -0.7, 20.0}) {
    for (const double angle_rad : {0.01, 0.049, 0.051, 1.0, -2.5, 7.0}) {
      for (const int steps : {1, 3, 1000}) {
        Chassis chassis(kB_m);
        for (int i = 0; i < steps; ++i) arc(chassis, radius_m, angle_rad / steps);
        const double scale = std::max(1.0, std::abs(radius_m));
        expect_pose(chassis.pose(), radius_m * std::sin(angle_rad), radius_m * (1.0 - std::cos(angle_rad)),
                    angle_rad, 1e-12 * scale);
      }
    }
  }
}

TEST(Chassis, SquareOfLinesAndSpinsClosesFromAnyPlace) {
  Chassis chassis(kB_m);
  const Pose start{1.5, -2.5, 0.7};
  chassis.place(start);
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < 6000; ++i) chassis.advance(0.0005, 0.0005);
    for (int i = 0; i < 500; ++i) arc(chassis, 0.0, std::numbers::pi / 1000.0);
  }
  expect_pose(chassis.pose(), start.x_m, start.y_m, start.theta_rad + 2.0 * std::numbers::pi, 1e-10);
}

TEST(Chassis, HeadingVectorKeepsWithTheHeadingForAnHour) {
  Chassis chassis(kB_m);
  for (int ms = 0; ms < 3'600'000; ++ms) chassis.advance(0.0003 + 1e-7 * (ms % 7), 0.00045);
  EXPECT_GT(chassis.pose().theta_rad, 1000.0) << "continuous, not wrapped";
  EXPECT_NEAR(chassis.cosine(), std::cos(chassis.pose().theta_rad), 1e-10);
  EXPECT_NEAR(chassis.sine(), std::sin(chassis.pose().theta_rad), 1e-10);
}

Geometry with_effect(double e) {
  Geometry geometry;
  geometry.wheelbase_m = kB_m;
  geometry.e = e;
  return geometry;
}

/// The wheelbase that steps of these wheel travels turn about, over the one of a spin.
double turned_about(double e, double left_m, double right_m) {
  Chassis chassis(with_effect(e));
  for (int i = 0; i < 1000; ++i) chassis.advance(left_m, right_m);
  return 1000 * (right_m - left_m) / chassis.pose().theta_rad / kB_m;
}

TEST(CurvatureEffect, LeavesASpinWhatItWas) {
  for (const double e : {-0.2, 0.03, 0.2}) {
    Chassis chassis(with_effect(e)), without(kB_m);
    for (int i = 0; i < 1000; ++i) {
      chassis.advance(-1e-4, 1e-4);
      without.advance(-1e-4, 1e-4);
    }
    EXPECT_EQ(chassis.pose().theta_rad, without.pose().theta_rad) << e;
  }
}

TEST(CurvatureEffect, TurnsAGentleArcAboutBTimesOnePlusE) {
  for (const double e : {-0.2, 0.03, 0.2})
    for (const double along_m : {-3e-4, 3e-4}) {
      // |R - L| is 1e-6 of the travel, and so g = 1 - 1e-6 / 0.12; 1e-9: roundings of the difference.
      const double half_m = 0.5e-6 * along_m;
      EXPECT_NEAR(turned_about(e, along_m - half_m, along_m + half_m), 1 + e,
                  std::abs(e) * 1e-6 / 0.12 + 1e-9)
          << e;
    }
}

TEST(CurvatureEffect, IsHalfAtTheCurvatureKappa0AndTheSameInAllSenses) {
  for (const double along_m : {-3e-4, 3e-4})
    for (const double half_m : {-0.06 * 3e-4, 0.06 * 3e-4})
      EXPECT_NEAR(turned_about(0.03, along_m - half_m, along_m + half_m), 1.015, 1e-12);  // roundings
}

TEST(CurvatureEffect, IsThatOfTheWheelsHoweverMuchTheySlip) {
  Chassis slipping(with_effect(0.03));
  // On a line the wheels slip as far apart as they roll, in steps of a third of a millimetre, and back.
  constexpr int kSteps = 1000;
  double turned_rad = 0;
  for (int step = 0; step < kSteps; ++step) {
    const double slip_m = step % 2 == 0 ? 3e-4 : -1e-4;
    slipping.advance(3e-4 - slip_m / 2, 3e-4 + slip_m / 2, 3e-4, 3e-4);
    turned_rad += slip_m / (kB_m * 1.03);
  }
  EXPECT_NEAR(slipping.pose().theta_rad, turned_rad, 1e-12);
}

TEST(CurvatureEffect, OfZeroIsTheSameToTheLastBit) {
  Chassis chassis(with_effect(0)), without(kB_m);
  for (int ms = 0; ms < 10'000; ++ms) {
    chassis.advance(0.0003 + 1e-7 * (ms % 7), 0.00045);
    without.advance(0.0003 + 1e-7 * (ms % 7), 0.00045);
  }
  EXPECT_EQ(chassis.pose().x_m, without.pose().x_m);
  EXPECT_EQ(chassis.pose().y_m, without.pose().y_m);
  EXPECT_EQ(chassis.pose().theta_rad, without.pose().theta_rad);
}

TEST(Geometry, DiametersFollowFromRatioAndScale) {
  Config config;
  config.true_ed = 1.00416;
  config.scale = 1.005;
  config.true_wheelbase_m = 0.290 * 0.99521;
  const Geometry geometry = true_geometry(config);
  EXPECT_NEAR(geometry.diameter_m[1] / geometry.diameter_m[0], 1.00416, 1e-15);
  EXPECT_NEAR(geometry.diameter_m[0] + geometry.diameter_m[1], 2.0 * 0.072 * 1.005, 1e-15);
  EXPECT_EQ(geometry.wheelbase_m, config.true_wheelbase_m);
}

// Dead reckoning in doubles on nothing but the counts, with the true geometry: what is left is one count of
// 81 um per wheel, which the wheelbase turns into heading and the way travelled into position.
TEST(Geometry, TrueParametersMakeDeadReckoningAgreeWithTruth) {
  Config config = ideal();
  config.true_ed = 1.00416;
  config.true_wheelbase_m = 0.28861;
  Board board(config);
  const Geometry geometry = true_geometry(config);
  Chassis reckoned(geometry.wheelbase_m);
  const double per_count = std::numbers::pi / (64.0 * 43.8);
  hal::EncoderCounts last{};
  for (int ms = 0; ms < 20000; ++ms) {
    if (ms % 2000 == 0) board.motors().drive({duty_for(6), duty_for(6)});
    if (ms % 2000 == 1500) board.motors().drive({duty_for(-2.5), duty_for(2.5)});
    board.advance_tick();
    const hal::EncoderCounts now = board.encoders().read();
    reckoned.advance(per_count * geometry.diameter_m[0] * (now.left - last.left),
                     per_count * geometry.diameter_m[1] * (now.right - last.right));
    last = now;
  }
  const Pose truth = board.truth();
  EXPECT_GT(std::abs(truth.theta_rad), 2.0);
  EXPECT_NEAR(reckoned.pose().theta_rad, truth.theta_rad, 1.01 * 81e-6 / 0.28861);
  EXPECT_NEAR(reckoned.pose().x_m, truth.x_m, 2e-3);
  EXPECT_NEAR(reckoned.pose().y_m, truth.y_m, 2e-3);
}

}  // namespace
}  // namespace astro::sim
