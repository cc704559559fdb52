#include "host/calibration/likelihood/gyro_pose_uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace astro::calibration {
namespace {

constexpr WheelFactors kFactors{1, 1, 0.29};
constexpr double kStep_s = 0.02;

OdometryErrors no_wheel_errors() { return {}; }

GyroErrors only(double random_walk_rad, double scale) {
  return {.random_walk_rad = random_walk_rad, .bias_walk_radps = 0, .scale = scale};
}

using Step = GyroPoseUncertainty::Step;

Step straight(double speed_mps) {
  return {
      .right_m = speed_mps * kStep_s, .left_m = speed_mps * kStep_s, .time_s = kStep_s, .gyro_counts = true};
}
Step spin(double rate_radps) {
  const double rim_m = rate_radps * kFactors.b_m / 2 * kStep_s;
  return {.right_m = rim_m,
          .left_m = -rim_m,
          .turn_rad = rate_radps * kStep_s,
          .time_s = kStep_s,
          .gyro_counts = true};
}
Step rest() { return {.time_s = kStep_s, .gyro_counts = true}; }

void repeat(GyroPoseUncertainty& uncertainty, const Step& step, double seconds) {
  for (int i = 0; i < std::lround(seconds / kStep_s); ++i) uncertainty.advance(step);
}

TEST(GyroPoseUncertainty, TheScaleCountsAsOftenAsTheRobotTurnsAndComesBackWithIt) {
  GyroPoseUncertainty uncertainty(kFactors, no_wheel_errors(), only(0, 0.01));
  repeat(uncertainty, spin(1), 10);
  EXPECT_NEAR(std::sqrt(uncertainty.covariance().tt), 0.01 * 10, 1e-6);
  repeat(uncertainty, spin(-1), 10);
  // The variance and not its root: rounding leaves some 1e-18 of the 0.01 that it was, of either sign.
  EXPECT_NEAR(uncertainty.covariance().tt, 0, 1e-15);
}

TEST(GyroPoseUncertainty, OfAStraightDriveGrowsAsTheIntegralOfTheHeadingsWalk) {
  constexpr double kWalk_rad = 1e-3, kSpeed_mps = 0.3, kTime_s = 20;
  GyroPoseUncertainty uncertainty(kFactors, no_wheel_errors(), only(kWalk_rad, 0));
  uncertainty.restart(0);
  repeat(uncertainty, straight(kSpeed_mps), kTime_s);
  const double bias_rad = kWalk_rad / std::sqrt(0.5);  // in a second, as half a second at rest has shown it
  const double heading = kWalk_rad * kWalk_rad * kTime_s + std::pow(bias_rad * kTime_s, 2);
  EXPECT_NEAR(uncertainty.covariance().tt, heading, 1e-3 * heading);
  const double across =
      kSpeed_mps * kSpeed_mps *
      (kWalk_rad * kWalk_rad * std::pow(kTime_s, 3) / 3 + std::pow(bias_rad * kTime_s * kTime_s / 2, 2));
  EXPECT_NEAR(uncertainty.covariance().yy, across, 2e-3 * across);
  EXPECT_NEAR(uncertainty.covariance().xx, 0, 1e-15);
}

TEST(GyroPoseUncertainty, AStandShowsTheBiasAndWinsBackTheHeadingThatItHasCost) {
  constexpr double kWalk_rad = 1e-3;
  GyroPoseUncertainty stood(kFactors, no_wheel_errors(), only(kWalk_rad, 0));
  repeat(stood, straight(0.3), 20);
  const double driven = std::sqrt(stood.covariance().tt);
  repeat(stood, rest(), 20);
  // Of both walk and bias only the walk of the drive itself is left, and what 20 s say about the bias then.
  const double left = std::sqrt(kWalk_rad * kWalk_rad * 20 + std::pow(kWalk_rad / std::sqrt(20.5) * 20, 2));
  EXPECT_LT(std::sqrt(stood.covariance().tt), 1.1 * left);
  EXPECT_LT(std::sqrt(stood.covariance().tt), driven / 3);
}

TEST(GyroPoseUncertainty, ARobotThatIsTurnedByHandIsAsUncertainAsTheGyrosScale) {
  constexpr double kScale = 0.01, kTurn_rad = 1.5;
  GyroPoseUncertainty uncertainty(kFactors, no_wheel_errors(), only(1e-5, kScale));
  repeat(uncertainty, rest(), 2);
  Step push = rest();
  push.turn_rad = kTurn_rad * kStep_s;
  repeat(uncertainty, push, 1);
  repeat(uncertainty, rest(), 2);
  EXPECT_NEAR(std::sqrt(uncertainty.covariance().tt), kScale * kTurn_rad, 0.01 * kScale * kTurn_rad);
}

TEST(GyroPoseUncertainty, ATurnBeyondTheGyrosRangeMayBeTwiceAsFar) {
  GyroPoseUncertainty uncertainty(kFactors, no_wheel_errors(), only(1e-5, 0));
  repeat(uncertainty, rest(), 2);
  uncertainty.advance({.turn_rad = 0.2, .time_s = kStep_s, .saturated = true});
  EXPECT_GE(std::sqrt(uncertainty.covariance().tt), 0.2);
}

TEST(GyroPoseUncertainty, WithoutAGyroThatCountsTheHeadingIsAsUncertainAsTheWheels) {
  OdometryErrors errors{2.645e-6, FactorCovariance::Zero()};
  errors.factors(0, 0) = 1e-6;
  errors.factors(2, 2) = 1e-6;
  GyroPoseUncertainty with(kFactors, errors, GyroErrors());
  PoseUncertainty wheels(kFactors, errors);
  with.restart(0.4);
  wheels.restart(0.4);
  for (int i = 0; i < 500; ++i) {
    const double right_m = 0.006, left_m = i % 100 < 50 ? 0.005 : -0.003;
    with.advance({.right_m = right_m,
                  .left_m = left_m,
                  .turn_rad = (right_m - left_m) / kFactors.b_m,
                  .time_s = kStep_s});
    wheels.travel(right_m, left_m);
  }
  const Symmetric3 a = with.covariance(), b = wheels.covariance();
  EXPECT_NEAR(a.tt, b.tt, 1e-3 * b.tt);
  // Steps here, exact arcs there; slip of a wheel acts on heading and travel together there, and on each alone here.
  EXPECT_NEAR(a.xx, b.xx, 0.03 * b.xx + 1e-6);
  EXPECT_NEAR(a.yy, b.yy, 0.03 * b.yy + 1e-6);
}

}  // namespace
}  // namespace astro::calibration
