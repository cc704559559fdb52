#include "host/lidar/stretch.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/host/lidar/synthetic_room.hpp"

namespace astro::lidar {
namespace {

SyntheticDrive curved_drive() {
  SyntheticDrive drive(furnished_room(), {{1, 1, kNominalBase_m}, 0}, {}, 1);
  drive.drive({{0.4, 0.3, 1}, {0.2, -0.5, 1}, {0, 0.8, 1}});
  return drive;
}

void expect_same(const Pose2& a, const Pose2& b, double within) {
  EXPECT_NEAR(a.x_m, b.x_m, within);
  EXPECT_NEAR(a.y_m, b.y_m, within);
  EXPECT_NEAR(a.theta_rad, b.theta_rad, within);
}

TEST(Stretch, OfTheLoadedFactorsIsTheWayDriven) {
  const SyntheticDrive drive = curved_drive();
  const Stretch stretch = cut_stretch(drive.recorded().wheels, kLoaded, 0, 3, 0);
  // Steps of 10 ms are put together to arcs of up to 0.02 rad, of which only those where the legs meet are no arcs.
  expect_same(predicted(stretch, nothing_wrong(kLoaded), kLoaded), drive.pose(), 1e-4);
}

TEST(Stretch, IsSeenFromTheScanner) {
  const SyntheticDrive drive = curved_drive();
  const Stretch stretch = cut_stretch(drive.recorded().wheels, kLoaded, 0, 3, 0);
  Unknowns unknowns = nothing_wrong(kLoaded);
  unknowns(kLeverX) = 0.2;
  unknowns(kLeverY) = -0.1;
  unknowns(kLeverYaw) = 3;
  const Pose2 lever = lever_of(unknowns);
  expect_same(predicted(stretch, unknowns, kLoaded), lever.inverse() * drive.pose() * lever, 1e-4);
}

TEST(Stretch, ThatIsCutLaterIsAsOneWithALateClock) {
  const std::vector<calibration::WheelSample> wheels = curved_drive().recorded().wheels;
  const Stretch early = cut_stretch(wheels, kLoaded, 0.5, 2.5, 0),
                late = cut_stretch(wheels, kLoaded, 0.5, 2.5, 0.05);
  Unknowns unknowns = nothing_wrong(kLoaded);
  unknowns(kLate) = 0.05;
  expect_same(predicted(early, unknowns, kLoaded), predicted(late, unknowns, kLoaded), 1e-4);
}

TEST(Stretch, UnknownsAreScaleTurnsAndBend) {
  Unknowns unknowns = nothing_wrong(kLoaded);
  unknowns(kScale) = 1.01;
  unknowns(kTurn) = 0.97;
  unknowns(kBend) = 0.02;
  const calibration::WheelFactors factors = factors_of(unknowns, {0.999, 1.002, 0.3});
  // A metre straight on by the loaded factors, and a turn on the spot by them.
  const double right_m = factors.c_r / 0.999, left_m = factors.c_l / 1.002;
  EXPECT_NEAR((right_m + left_m) / 2, 1.01, 1e-12);
  EXPECT_NEAR((right_m - left_m) / factors.b_m, 0.02, 1e-12);
  const double rim_m = 0.3 / 2;
  EXPECT_NEAR((right_m * rim_m + left_m * rim_m) / factors.b_m, 0.97, 1e-12);
}

TEST(ScannedDrive, HasSecondsOfTimesThatLieFarApart) {
  ScannedDrive drive;
  Scan scan;
  drive.origin_ns = std::numeric_limits<std::int64_t>::max();
  scan.time_ns = std::numeric_limits<std::int64_t>::min();
  EXPECT_NEAR(drive.seconds(scan), -18'446'744'073.7, 0.1);
  drive.origin_ns = 1'790'000'000'900'000'000;
  scan.time_ns = 1'790'000'001'100'000'001;
  EXPECT_NEAR(drive.seconds(scan), 0.200000001, 1e-12);
}

}  // namespace
}  // namespace astro::lidar
