#include "host/lidar/scan_match.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "host/lidar/pair_match.hpp"
#include "tests/host/lidar/synthetic_room.hpp"

namespace astro::lidar {
namespace {

Scan scan_from(const Room& room, const Pose2& pose, const Scanner& scanner, std::mt19937_64& random) {
  Scanner there = scanner;
  there.place = pose;
  return SyntheticDrive(room, {{1, 1, kNominalBase_m}, 0}, there, 1).scan_at(0, random);
}

Eigen::Vector3d off(const Pose2& a, const Pose2& b) {
  const Pose2 apart = difference(a, b);
  return {apart.x_m, apart.y_m, apart.theta_rad};
}

TEST(ScanMatch, FindsHowFarTheScannerMoved) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-2, 2), turn(-3, 3), step(-0.3, 0.3);
  for (int trial = 0; trial < 50; ++trial) {
    const Pose2 first{place(random), place(random), turn(random)};
    const Pose2 motion{step(random), step(random), step(random)};
    Scanner scanner;
    const NearestPoints reference(surface_of(scan_from(furnished_room(), first, scanner, random), {}));
    const auto points = surface_of(scan_from(furnished_room(), first * motion, scanner, random), {});
    const auto found = match(reference, points, {});
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->degenerate());
    // Ranges are off by 1 cm, and some hundred of them count: the motion is off by a millimetre or two.
    EXPECT_LT(off(found->motion, motion).head<2>().norm(), 0.01) << "trial " << trial;
    EXPECT_LT(std::abs(off(found->motion, motion)(2)), 0.003) << "trial " << trial;
  }
}

TEST(ScanMatch, KnowsHowFarItIsOff) {
  std::mt19937_64 random(8);
  const Pose2 first{-1, 0.5, 0.3}, motion{0.35, 0.02, 0.1};
  double sum = 0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    Scanner scanner;
    const NearestPoints reference(surface_of(scan_from(furnished_room(), first, scanner, random), {}));
    const auto points = surface_of(scan_from(furnished_room(), first * motion, scanner, random), {});
    const auto found = match(reference, points, {0.3, 0, 0.05});
    ASSERT_TRUE(found);
    const Eigen::Vector3d error = off(found->motion, motion);
    sum += error.dot(found->covariance.inverse() * error) / 3 / kTrials;
  }
  // The covariance is never taken to be better than ranges of 15 mm allow, and these are good to 10 mm: it may be large by a
  // factor of four, but not small.
  EXPECT_LT(sum, 1.25);
  EXPECT_GT(sum, 0.1);
}

TEST(ScanMatch, InACorridorKeepsTheMotionAlongItAndSaysThatItIsUnknown) {
  std::mt19937_64 random(9);
  Scanner scanner;
  for (int trial = 0; trial < 20; ++trial) {
    const NearestPoints reference(surface_of(scan_from(corridor(), {0, 0.2, 0.1}, scanner, random), {}));
    const auto points = surface_of(scan_from(corridor(), {0.4, 0.2, 0.1}, scanner, random), {});
    const Pose2 start = Pose2{0, 0.2, 0.1}.between({0.5, 0.15, 0.13});  // 10 cm too far, 5 cm aside
    const auto found = match(reference, points, start);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->degenerate());
    const Pose2 end = Pose2{0, 0.2, 0.1} * found->motion;
    EXPECT_NEAR(end.x_m, 0.5, 0.02);  // as the start says
    EXPECT_NEAR(end.y_m, 0.2, 0.01);  // as the walls say
    EXPECT_NEAR(end.theta_rad, 0.1, 0.005);
  }
}

TEST(ScanMatch, IgnoresAPersonWhoWalksBy) {
  std::mt19937_64 random(10);
  Scanner scanner;
  const auto with_person = [](double x_m) {
    Room room = furnished_room();
    add_walls(room, {{x_m, 0.8}, {x_m + 0.4, 0.8}, {x_m + 0.4, 1.1}, {x_m, 1.1}});
    return room;
  };
  const Pose2 motion{0.4, 0, 0.05};
  const NearestPoints reference(surface_of(scan_from(with_person(0.5), {}, scanner, random), {}));
  const auto points = surface_of(scan_from(with_person(0.75), motion, scanner, random), {});
  const auto found = match(reference, points, {});
  ASSERT_TRUE(found);
  EXPECT_LT(off(found->motion, motion).head<2>().norm(), 0.01);
}

TEST(ScanMatch, OfTooFewPointsIsNone) {
  const NearestPoints nothing(std::vector<SurfacePoint>{});
  EXPECT_FALSE(match(nothing, {}, {}));
  EXPECT_FALSE(trusted_match(nothing, {}, {}));
}

TEST(ScanMatch, OfAnotherRoomIsNotTrusted) {
  std::mt19937_64 random(11);
  Scanner scanner;
  Room small;
  add_walls(small, {{-1, -0.7}, {1.1, -0.7}, {1.1, 0.9}, {-1, 0.9}});
  const NearestPoints reference(surface_of(scan_from(furnished_room(), {}, scanner, random), {}));
  EXPECT_FALSE(trusted_match(reference, surface_of(scan_from(small, {}, scanner, random), {}), {}));
}

}  // namespace
}  // namespace astro::lidar
