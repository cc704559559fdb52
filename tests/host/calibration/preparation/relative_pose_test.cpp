#include "host/calibration/preparation/relative_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace astro::calibration {
namespace {

constexpr RelativePoseFit kRobot{0.0412, 0.0408, 0.151, {0.07, -0.03, 2.2}};

std::vector<RelativePose> pieces(int count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> travel(-3, 3);  // radians of the wheel
  std::vector<RelativePose> all;
  for (int i = 0; i < count; ++i) {
    RelativePose piece;
    for (int step = 0; step < 3; ++step) piece.steps.push_back({travel(random) / 3, travel(random) / 3});
    all.push_back(predicted(piece, kRobot));
  }
  return all;
}

void expect_robot(const RelativePoseFit& fit, double tolerance) {
  EXPECT_NEAR(fit.r_left, kRobot.r_left, tolerance);
  EXPECT_NEAR(fit.r_right, kRobot.r_right, tolerance);
  EXPECT_NEAR(fit.b_m, kRobot.b_m, tolerance);
  EXPECT_NEAR(fit.sensor.x_m, kRobot.sensor.x_m, tolerance);
  EXPECT_NEAR(fit.sensor.y_m, kRobot.sensor.y_m, tolerance);
  EXPECT_NEAR(fit.sensor.theta_rad, kRobot.sensor.theta_rad, tolerance);
}

TEST(RelativePoses, GiveTheRobotBackThatTheyWereMadeFrom) {
  std::mt19937_64 random(1);
  // Rounding only; the smallest eigenvalue is zero.
  expect_robot(fit_relative_poses(pieces(50, random)).value(), 1e-9);
}

TEST(RelativePoses, AreTrimmedOfTheWorst) {
  std::mt19937_64 random(2);
  std::vector<RelativePose> all = pieces(200, random);
  all[17].moved.x_m += 0.5;
  all[90].moved.theta_rad += 1;
  EXPECT_GT(std::abs(fit_relative_poses(all).value().b_m - kRobot.b_m), 1e-4);
  // Two pieces in 200 are a hundredth: gone after two rounds of a hundredth each.
  expect_robot(fit_relative_poses_trimmed(all, 2, 0.01).value(), 1e-9);
}

TEST(RelativePoses, TellAWheelThatTurnsBackwards) {
  RelativePoseFit reversed = kRobot;
  reversed.r_left = -reversed.r_left;
  std::mt19937_64 random(3);
  std::vector<RelativePose> all = pieces(50, random);
  for (RelativePose& piece : all) piece = predicted(piece, reversed);
  EXPECT_NEAR(fit_relative_poses(all).value().r_left, reversed.r_left, 1e-9);
}

TEST(RelativePoses, SayNothingWhereAnUnknownIsOpen) {
  std::vector<RelativePose> lines, spins;
  for (int i = 1; i < 20; ++i) {
    lines.push_back(predicted({{{1.0 * i, 1.0 * i}}}, {0.04, 0.04, 0.15, {}}));
    spins.push_back(predicted({{{-0.1 * i, 0.1 * i}}}, {0.04, 0.04, 0.15, {}}));
  }
  EXPECT_FALSE(fit_relative_poses(lines));
  EXPECT_FALSE(fit_relative_poses(spins));
  EXPECT_FALSE(fit_relative_poses({}));
}

}  // namespace
}  // namespace astro::calibration
