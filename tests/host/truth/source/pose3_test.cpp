#include "host/truth/source/pose3.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "host/truth/source/floor_track.hpp"

namespace astro::truth {
namespace {

constexpr double kPi = std::numbers::pi;

/// A robot at (1, 2) that is turned by `theta_rad` and tilted by `tilt_rad` about its own x, with z up.
Pose3 tilted(double theta_rad, double tilt_rad) {
  const double c = std::cos(theta_rad / 2), s = std::sin(theta_rad / 2);
  const double u = std::cos(tilt_rad / 2), v = std::sin(tilt_rad / 2);
  return {1, 2, 0.3, c * v, s * v, s * u, c * u};
}

/// The same as a tracker with y up shows it.
Pose3 with_y_up(const Pose3& p) { return {p.x_m, p.z_m, -p.y_m, p.qx, p.qz, -p.qy, p.qw}; }

TEST(OnFloor, TheHeadingIsTheTurnAboutTheUpAxisWhicheverThatIs) {
  for (const double theta_rad : {-3.0, -0.4, 0.0, 1.0, 2.5}) {
    const Pose2 z = on_floor(tilted(theta_rad, 0), UpAxis::z);
    const Pose2 y = on_floor(with_y_up(tilted(theta_rad, 0)), UpAxis::y);
    for (const Pose2& pose : {z, y}) {
      EXPECT_EQ(pose.x_m, 1);
      EXPECT_EQ(pose.y_m, 2);
      EXPECT_NEAR(pose.theta_rad, theta_rad, 1e-12);
    }
  }
}

TEST(OnFloor, ATiltOfAFewDegreesDoesNotChangeTheHeading) {
  for (const double tilt_rad : {-0.1, 0.1})
    EXPECT_NEAR(on_floor(tilted(1.2, tilt_rad), UpAxis::z).theta_rad, 1.2, 1e-12);
}

TEST(OnFloor, QAndMinusQAreOneHeading) {
  const Pose3 p = tilted(2.8, 0.05);
  const Pose3 flipped{p.x_m, p.y_m, p.z_m, -p.qx, -p.qy, -p.qz, -p.qw};
  EXPECT_NEAR(on_floor(flipped, UpAxis::z).theta_rad, on_floor(p, UpAxis::z).theta_rad, 1e-12);
}

TEST(PossiblePoses, AreFiniteNearbyAndRotations) {
  EXPECT_TRUE(is_possible(tilted(1, 0)));
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_possible({0, 0, 0, 0, 0, 0, 0})) << "what trackers send of a lost body";
  EXPECT_FALSE(is_possible({nan, 0, 0, 0, 0, 0, 1}));
  EXPECT_FALSE(is_possible({0, 0, -infinite, 0, 0, 0, 1}));
  EXPECT_FALSE(is_possible({0, 0, 0, 0, 0, nan, 1}));
  EXPECT_FALSE(is_possible({0, 0, 0, 0, 0, 0, 1e9}));
  EXPECT_FALSE(is_possible({1e9, 0, 0, 0, 0, 0, 1}));
}

TEST(FloorTrack, HeadingsGoOnBeyondHalfATurn) {
  FloorTrack track(UpAxis::z);
  double last_rad = 0;
  for (int i = 0; i <= 100; ++i)
    last_rad = track.take(i, tilted(std::remainder(0.2 * i, 2 * kPi), 0)).theta_rad;
  EXPECT_NEAR(last_rad, 20, 1e-9);
}

TEST(FloorTrack, ALostBodyIsInvalidAndTheHeadingGoesOnBehindIt) {
  FloorTrack track(UpAxis::z);
  track.take(0, tilted(3, 0));
  EXPECT_FALSE(track.take(1, {0, 0, 0, 0, 0, 0, 0}).valid);
  EXPECT_FALSE(track.take(2, tilted(3.05, 0), false).valid) << "the tracker says so";
  const recording::TruthSample again = track.take(3, tilted(-3, 0));
  EXPECT_TRUE(again.valid);
  EXPECT_NEAR(again.theta_rad, 2 * kPi - 3, 1e-9);
}

TEST(FloorTrack, APoseThatIsRepeatedToTheLastDigitIsNotMeasured) {
  FloorTrack track(UpAxis::z);
  EXPECT_TRUE(track.take(0, tilted(1, 0)).valid);
  EXPECT_FALSE(track.take(1, tilted(1, 0)).valid);
  EXPECT_FALSE(track.take(2, tilted(1, 0)).valid);
  EXPECT_TRUE(track.take(3, tilted(1 + 1e-12, 0)).valid);
}

}  // namespace
}  // namespace astro::truth
