#include "host/base/pose2.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

namespace astro {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using std::numbers::pi;

constexpr int kTrials = 2000;
// Headings of up to 60 rad are rounded by 4e-15 rad, which at 300 m is some 1e-12 m.
constexpr double kRounding = 2e-12;

class Pose2Laws : public testing::Test {
 protected:
  double number(double most) { return std::uniform_real_distribution(-most, most)(random_); }
  /// With up to three whole turns.
  Pose2 pose() {
    const double x_m = number(100), y_m = number(100);
    return {x_m, y_m, number(20)};
  }

 private:
  static constexpr unsigned kSeed = 20261218;
  std::mt19937_64 random_{kSeed};
  testing::ScopedTrace trace_{__FILE__, __LINE__, "seed " + std::to_string(kSeed)};
};

void expect_near(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x_m, b.x_m, tolerance);
  EXPECT_NEAR(a.y_m, b.y_m, tolerance);
  EXPECT_NEAR(a.theta_rad, b.theta_rad, tolerance);
}

Matrix3d matrix_of(const Pose2& pose) {
  Matrix3d matrix;
  matrix << std::cos(pose.theta_rad), -std::sin(pose.theta_rad), pose.x_m,  //
      std::sin(pose.theta_rad), std::cos(pose.theta_rad), pose.y_m,         //
      0, 0, 1;
  return matrix;
}

void expect_same_matrix(const Pose2& pose, const Matrix3d& matrix, double tolerance) {
  EXPECT_LT((matrix_of(pose) - matrix).cwiseAbs().maxCoeff(), tolerance);
}

/// The exponential of a matrix by its own series, after the motion was divided by 2^10.
Matrix3d exponential(const Twist2& twist) {
  Matrix3d generator;
  generator << 0, -twist.theta_rad, twist.x_m, twist.theta_rad, 0, twist.y_m, 0, 0, 0;
  generator /= 1024;
  Matrix3d sum = Matrix3d::Identity(), term = Matrix3d::Identity();
  for (int i = 1; i < 12; ++i) sum += term = Matrix3d(term * generator / i);
  for (int i = 0; i < 10; ++i) sum = Matrix3d(sum * sum);
  return sum;
}

TEST_F(Pose2Laws, CompositionIsAssociative) {
  for (int i = 0; i < kTrials; ++i) {
    const Pose2 a = pose(), b = pose(), c = pose();
    expect_near((a * b) * c, a * (b * c), kRounding);
  }
}

TEST_F(Pose2Laws, AnInverseUndoesAPoseFromEitherSide) {
  for (int i = 0; i < kTrials; ++i) {
    const Pose2 a = pose();
    expect_near(a * a.inverse(), {}, kRounding);
    expect_near(a.inverse() * a, {}, kRounding);
    EXPECT_EQ((a * a.inverse()).theta_rad, 0);
  }
}

TEST_F(Pose2Laws, ArePlainMatrices) {
  for (int i = 0; i < kTrials; ++i) {
    const Pose2 a = pose(), b = pose();
    const Matrix3d A = matrix_of(a), B = matrix_of(b);
    expect_same_matrix(a * b, A * B, kRounding);
    expect_same_matrix(a.inverse(), A.inverse(), kRounding);
    expect_same_matrix(a.between(b), A.inverse() * B, kRounding);
    const Point2 p{number(100), number(100)}, seen = a * p;
    const Vector3d expected = A * Vector3d(p.x_m, p.y_m, 1);
    EXPECT_NEAR(seen.x_m, expected.x(), kRounding);
    EXPECT_NEAR(seen.y_m, expected.y(), kRounding);
  }
}

TEST_F(Pose2Laws, BetweenLeadsFromOnePoseToTheOther) {
  for (int i = 0; i < kTrials; ++i) {
    const Pose2 a = pose(), b = pose();
    expect_near(a * a.between(b), b, kRounding);
    expect_near(a.between(b), a.inverse() * b, kRounding);
    expect_near(a.between(b), b.between(a).inverse(), kRounding);
  }
}

TEST(Pose2, PosesFarAwayAndCloseToEachOtherKeepTheirDigits) {
  constexpr double kAhead_m = 1.0 / 1024;  // exact beside 4000 km
  const Pose2 a{4e6, -3e6, 0.7}, moved = a.between({4e6 + kAhead_m, -3e6, 0.7});
  expect_near(moved, {kAhead_m * std::cos(0.7), -kAhead_m * std::sin(0.7), 0}, 1e-18);
}

TEST_F(Pose2Laws, ExpIsTheExponentialOfTheMatrix) {
  for (int i = 0; i < kTrials; ++i) {
    const Twist2 twist{number(10), number(10), number(20)};
    // Ten squarings double the rounding of 10 m each.
    expect_same_matrix(twist.exp(), exponential(twist), 1e-11);
  }
}

TEST_F(Pose2Laws, LogAndExpUndoEachOther) {
  for (int i = 0; i < kTrials; ++i) {
    const Pose2 a = pose();
    if (std::abs(wrapped_rad(a.theta_rad)) < 0.1 && std::abs(a.theta_rad) > 1)
      continue;  // almost whole turns
    const Twist2 log = a.log();
    EXPECT_EQ(log.theta_rad, a.theta_rad);
    // The length of the motion is the longer, the nearer it comes to whole turns.
    expect_near(log.exp(), a, kRounding);
    const Twist2 again = log.exp().log();
    EXPECT_NEAR(again.x_m, log.x_m, 1e-10);
    EXPECT_NEAR(again.y_m, log.y_m, 1e-10);
  }
}

TEST_F(Pose2Laws, AMotionIsThatOfItsPartsOneAfterTheOther) {
  for (int i = 0; i < 50; ++i) {
    const Twist2 whole{number(10), number(10), number(20)};
    for (const int parts : {2, 7, 1000}) {
      const Twist2 part{whole.x_m / parts, whole.y_m / parts, whole.theta_rad / parts};
      Pose2 at;
      for (int k = 0; k < parts; ++k) at = at * part.exp();
      expect_near(at, whole.exp(), 1e-12 * parts);
    }
  }
}

TEST(Pose2, SmallTurnsLoseNoDigits) {
  for (double turn = 1; turn > 1e-300; turn *= 0.71) {
    for (const double theta : {turn, -turn}) {
      SCOPED_TRACE("turn " + std::to_string(theta));
      const long double t = theta, half = std::sin(t / 2);
      // 1 - cos(t) as 2 sin^2(t / 2), which does not cancel.
      const auto along = static_cast<double>(std::sin(t) / t),
                 across = static_cast<double>(2 * half * half / t);
      const Pose2 moved = Twist2{1, 0, theta}.exp();
      constexpr double kFew = 4 * std::numeric_limits<double>::epsilon();
      EXPECT_NEAR(moved.x_m, along, kFew);
      EXPECT_NEAR(moved.y_m, across, kFew * std::abs(across));
      const Twist2 back = moved.log();
      EXPECT_NEAR(back.x_m, 1, kFew);
      EXPECT_NEAR(back.y_m, 0, kFew * std::abs(theta));
    }
  }
}

TEST(Pose2, StraightOnIsExact) {
  const Pose2 moved = Twist2{0.3, -0.1, 0}.exp();
  EXPECT_EQ(moved.x_m, 0.3);
  EXPECT_EQ(moved.y_m, -0.1);
  EXPECT_EQ(moved.theta_rad, 0);
  EXPECT_EQ(moved.log().x_m, 0.3);
}

TEST(Pose2, AQuarterTurnIsAQuarterOfACircle) {
  expect_near(Twist2{2 * pi / 2, 0, pi / 2}.exp(), {2, 2, pi / 2}, 1e-15);  // of radius 2
}

TEST(Pose2, WholeTurnsCount) {
  for (const int turns : {-3, -1, 1, 2}) {
    const double theta_rad = 2 * pi * turns;
    expect_near(Twist2{5, 0, theta_rad}.exp(), {0, 0, theta_rad}, 5e-15);  // a circle ends where it began
    EXPECT_EQ((Pose2{1, 2, theta_rad} * Pose2{0, 0, theta_rad}).theta_rad, 2 * theta_rad);
    EXPECT_EQ((Pose2{1, 2, 0.5}.between({1, 2, 0.5 + theta_rad})).theta_rad, 0.5 + theta_rad - 0.5);
    EXPECT_NEAR(wrapped({1, 2, 0.5 + theta_rad}).theta_rad, 0.5, 1e-14);
    EXPECT_NEAR(difference({1, 2, 3 + theta_rad}, {0, 0, -3}).theta_rad, 6 - 2 * pi, 1e-14);
    EXPECT_GT(std::abs((Pose2{1, 0, theta_rad}.log().x_m)), 1e15)
        << "no motion of whole turns ends beside its start";
  }
}

TEST(Pose2, AMissingHeadingSpoilsNoPositionThatDoesNotNeedIt) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Pose2 known{1, 2, 0.3}, headless{4, 5, kNone};
  for (const Pose2& pose : {known * headless, known.between(headless), difference(headless, known)}) {
    EXPECT_TRUE(std::isfinite(pose.x_m) && std::isfinite(pose.y_m));
    EXPECT_TRUE(std::isnan(pose.theta_rad));
  }
}

TEST(Pose2, ADifferenceIsByCoordinate) {
  expect_near(difference({3, -1, 0.5}, {1, 1, 0.75}), {2, -2, -0.25}, 0);
}

}  // namespace
}  // namespace astro
