#include "host/lidar/scan_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/host/lidar/synthetic_room.hpp"

namespace astro::lidar {
namespace {

constexpr Robot kWrong{{1.013, 1.007, 0.306}, 0};

/// Root mean square distance of a map's points from the walls of the room where the robot drove.
double blur_m(const std::vector<Point2>& map) {
  const Room room = furnished_room();
  double sum = 0;
  for (const Point2& point : map) sum += std::pow(off_walls_m(room, point), 2);
  return std::sqrt(sum / static_cast<double>(map.size()));
}

TEST(ScanMap, IsSharpWithTheRightFactorsAndBlurredWithOthers) {
  Scanner scanner;
  scanner.place = {0.08, -0.03, 1.0};
  scanner.spins = true;
  SyntheticDrive drive(furnished_room(), kWrong, scanner, 3);
  drive_both_ways(drive, 1);
  const ScannedDrive recorded = drive.recorded();
  Unknowns place = nothing_wrong(kLoaded);
  place(kLeverX) = 0.08;
  place(kLeverY) = -0.03;
  place(kLeverYaw) = 1.0;
  const std::vector<Point2> right = map_by_wheels(recorded, kWrong.actual, place, false, 100'000),
                            wrong = map_by_wheels(recorded, kLoaded, place, false, 100'000);
  ASSERT_GT(right.size(), 10'000u);
  EXPECT_LT(blur_m(right), 0.015) << "noise of 1 cm, and that along grazed walls";
  EXPECT_GT(blur_m(wrong), 3 * blur_m(right));
}

TEST(ScanMap, HasNoMorePointsThanAreWanted) {
  SyntheticDrive drive(furnished_room(), kWrong, {}, 3);
  drive_both_ways(drive, 1);
  const ScannedDrive recorded = drive.recorded();
  const std::size_t few = map_by_wheels(recorded, kLoaded, nothing_wrong(kLoaded), false, 1000).size();
  EXPECT_LE(few, 1000u);
  EXPECT_GT(few, 500u);
}

}  // namespace
}  // namespace astro::lidar
