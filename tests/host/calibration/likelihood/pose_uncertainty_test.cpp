#include "host/calibration/likelihood/pose_uncertainty.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "host/calibration/motion/arc.hpp"

namespace astro::calibration {
namespace {

constexpr WheelFactors kFactorsOfRobot{1.001, 0.998, 0.29, 0.01};

Vector3 change(const Pose2& a, const Pose2& b) {
  return {a.x_m - b.x_m, a.y_m - b.y_m, a.theta_rad - b.theta_rad};
}

/// A drive of lines, arcs and spins, in steps as telemetry brings them.
template <class Step>
void course(Step&& step) {
  std::mt19937_64 random(20261124);
  std::uniform_real_distribution<double> travel(-0.05, 0.15);
  for (int part = 0; part < 12; ++part) {
    const double right_m = travel(random), left_m = part % 4 == 0 ? -right_m : travel(random);
    for (int i = 0; i < 20; ++i) step(right_m, left_m);
  }
}

Pose2 dead_reckoned(const WheelFactors& factors, const Pose2& start) {
  Pose2 pose = start;
  course([&](double right_m, double left_m) { advance(pose, right_m, left_m, factors); });
  return pose;
}

Symmetric3 propagated(const OdometryErrors& errors, double heading_rad, const Symmetric3& start = {}) {
  PoseUncertainty uncertainty(kFactorsOfRobot, errors);
  uncertainty.travel(3, 2);  // before the pose is set
  uncertainty.restart(heading_rad, start);
  course([&](double right_m, double left_m) { uncertainty.travel(right_m, left_m); });
  return uncertainty.covariance();
}

void expect_near(const Symmetric3& a, const Symmetric3& b, double relative) {
  const double x = relative * std::sqrt(b.xx), y = relative * std::sqrt(b.yy), t = relative * std::sqrt(b.tt);
  const double X = std::sqrt(b.xx), Y = std::sqrt(b.yy), T = std::sqrt(b.tt);
  EXPECT_NEAR(a.xx, b.xx, x * X);
  EXPECT_NEAR(a.xy, b.xy, x * Y);
  EXPECT_NEAR(a.xt, b.xt, x * T);
  EXPECT_NEAR(a.yy, b.yy, y * Y);
  EXPECT_NEAR(a.yt, b.yt, y * T);
  EXPECT_NEAR(a.tt, b.tt, t * T);
}

Symmetric3 square(const Vector3& v) {
  return {v[0] * v[0], v[0] * v[1], v[0] * v[2], v[1] * v[1], v[1] * v[2], v[2] * v[2]};
}

TEST(PoseUncertainty, OfAWrongFactorIsTheSquareOfWhatItDoesToThePath) {
  constexpr double kStep = 1e-7;
  const Pose2 start{1, 2, 0.7}, nominal = dead_reckoned(kFactorsOfRobot, start);
  for (int factor = 0; factor < 4; ++factor) {
    WheelFactors wrong = kFactorsOfRobot;
    (factor == 0 ? wrong.c_r : factor == 1 ? wrong.c_l : factor == 2 ? wrong.b_m : wrong.e) += kStep;
    Vector3 by = change(dead_reckoned(wrong, start), nominal);
    for (double& each : by) each /= kStep;
    OdometryErrors errors;
    errors.factors(factor, factor) = 1;
    // A difference quotient is as good as its step.
    expect_near(propagated(errors, start.theta_rad), square(by), 1e-4);
  }
}

TEST(PoseUncertainty, FactorsThatAreWrongTogetherCancelOrAdd) {
  const Pose2 start{0, 0, -1};
  Vector3 sum{};
  const Pose2 nominal = dead_reckoned(kFactorsOfRobot, start);
  WheelFactors both = kFactorsOfRobot;
  both.c_r += 1e-6;
  both.c_l += 1e-6;
  sum = change(dead_reckoned(both, start), nominal);
  for (double& each : sum) each /= 1e-6;
  OdometryErrors errors;
  errors.factors.topLeftCorner<2, 2>().setOnes();
  expect_near(propagated(errors, start.theta_rad), square(sum), 1e-4);
}

TEST(PoseUncertainty, OfTheStartTurnsAboutWhereThePoseWasSet) {
  const Pose2 start{0, 0, 0.3};
  const Pose2 end = dead_reckoned(kFactorsOfRobot, start);
  const Symmetric3 of_heading{0, 0, 0, 0, 0, 1};
  expect_near(propagated({}, start.theta_rad, of_heading), square({-end.y_m, end.x_m, 1}), 1e-9);
  const Symmetric3 of_place{4, 1, 0, 9, 0, 1e-12};
  const Symmetric3 there = propagated({}, start.theta_rad, of_place);
  EXPECT_NEAR(there.xx, 4, 1e-9);
  EXPECT_NEAR(there.xy, 1, 1e-9);
  EXPECT_NEAR(there.yy, 9, 1e-9);
}

TEST(PoseUncertainty, OfSlipIsTheScatterOfRobotsThatSlip) {
  constexpr double kSlip_m = 1e-7;  // so small that the path's bending does not count
  const Pose2 start{0, 0, 0.5};
  const Pose2 nominal = dead_reckoned(kFactorsOfRobot, start);
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  constexpr int kRobots = 20'000;
  Symmetric3 scatter;
  for (int i = 0; i < kRobots; ++i) {
    Pose2 pose = start;
    course([&](double right_m, double left_m) {
      const double right = right_m + std::sqrt(kSlip_m * std::abs(right_m)) * normal(random);
      const double left = left_m + std::sqrt(kSlip_m * std::abs(left_m)) * normal(random);
      advance(pose, right, left, kFactorsOfRobot);
    });
    scatter += (1.0 / kRobots) * square(change(pose, nominal));
  }
  // Twenty thousand robots tell a variance to one per cent.
  expect_near(propagated({kSlip_m, FactorCovariance::Zero()}, start.theta_rad), scatter, 0.04);
}

TEST(PoseUncertainty, DoesNotGrowWhileAWheelFlickersBetweenTwoCounts) {
  PoseUncertainty uncertainty(kFactorsOfRobot, {1e-6, FactorCovariance::Zero()});
  uncertainty.restart(0);
  for (int i = 0; i < 360'000; ++i) uncertainty.travel(i % 2 == 0 ? 1e-5 : -1e-5, 0);
  EXPECT_LE(uncertainty.covariance().tt, 1e-6 * 2e-5 / (0.29 * 0.29));
}

TEST(PoseUncertainty, GrowsTheSameWhateverTheStepsOfAnArc) {
  const auto after = [](int steps) {
    PoseUncertainty uncertainty(kFactorsOfRobot, {1e-6, FactorCovariance::Identity() * 1e-8});
    uncertainty.restart(0);
    for (int i = 0; i < steps; ++i) uncertainty.travel(3.0 / steps, 2.5 / steps);
    return uncertainty.covariance();
  };
  expect_near(after(100), after(10'000), 1e-3);
}

}  // namespace
}  // namespace astro::calibration
