#include "host/lidar/surface.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/host/lidar/synthetic_room.hpp"

namespace astro::lidar {
namespace {

/// What a scanner that neither errs nor loses beams sees in the furnished room.
Scan clean_scan(const Scanner& scanner) {
  std::mt19937_64 random(1);
  return SyntheticDrive(furnished_room(), {{1, 1, kNominalBase_m}, 0}, scanner, 1).scan_at(0, random);
}

Scanner clean() {
  Scanner scanner;
  scanner.noise_m = scanner.lost = 0;
  return scanner;
}

TEST(Surface, OfAWallHasNormalsAcrossIt) {
  Scan scan;
  scan.first_angle_rad = -0.5;
  scan.angle_step_rad = 0.01;
  scan.range_max_m = 10;
  for (int beam = 0; beam <= 100; ++beam)  // a wall at x = 2
    scan.ranges_m.push_back(static_cast<float>(2 / std::cos(-0.5 + 0.01 * beam)));
  const std::vector<SurfacePoint> points = surface_of(scan, {});
  ASSERT_EQ(points.size(), 101u);
  for (const SurfacePoint& point : points) {
    EXPECT_NEAR(point.at.x_m, 2, 1e-6);  // ranges are floats
    EXPECT_TRUE(point.on_line);
    EXPECT_NEAR(std::abs(point.normal.x_m), 1, 1e-5);
  }
}

TEST(Surface, HasOnlyPointsThatAreSomewhere) {
  Scan scan;
  scan.angle_step_rad = 0.01;
  scan.beam_interval_s = 1e-3;
  scan.range_max_m = 10;
  scan.ranges_m.assign(100, 2);
  const Twist2 way{std::numeric_limits<double>::infinity(), 0, 0};
  EXPECT_EQ(surface_of(scan, {&way, 1}).size(), 1u);  // the first beam
}

TEST(Surface, HasNoNormalWhereTheWallBends) {
  const std::vector<SurfacePoint> points = surface_of(clean_scan(clean()), {});
  const Point2 corner{-5, -4};
  const auto nearest = std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
    return std::hypot(a.at.x_m - corner.x_m, a.at.y_m - corner.y_m) <
           std::hypot(b.at.x_m - corner.x_m, b.at.y_m - corner.y_m);
  });
  EXPECT_FALSE(nearest->on_line);
  const auto on_lines =
      std::count_if(points.begin(), points.end(), [](const auto& point) { return point.on_line; });
  EXPECT_GT(on_lines, 0.7 * static_cast<double>(points.size()));  // most of the room is walls
}

TEST(Surface, LeavesOutWhatIsBeyondTheLimitsAndWhatIsNoNumber) {
  Scan scan;
  scan.angle_step_rad = 0.01;
  scan.range_min_m = 0.1;
  scan.range_max_m = 5;
  scan.ranges_m = {
      0.0F, 0.05F, 1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
      5.0F, 7.0F,  -1.0F};
  EXPECT_EQ(surface_of(scan, {}).size(), 1u);
}

TEST(Surface, OfAScannerThatTurnsWhileItDrivesIsAsIfItHadStood) {
  Scanner scanner = clean();
  scanner.spins = true;
  SyntheticDrive drive(furnished_room(), {{1, 1, kNominalBase_m}, 0}, scanner, 1);
  drive.drive({0.5, 1.2, 1});
  std::mt19937_64 random(1);
  const Twist2 way{0.5 * scanner.period_s, 0, 1.2 * scanner.period_s};
  const std::vector<SurfacePoint> moved = surface_of(drive.scan_at(0, random), {&way, 1});
  scanner.spins = false;
  Scan still = SyntheticDrive(furnished_room(), {{1, 1, kNominalBase_m}, 0}, scanner, 1).scan_at(0, random);
  // Each point lies on a wall of the room, seen from where the scan began.
  const Room room = furnished_room();
  for (const SurfacePoint& point : moved) {
    const double range_m = std::hypot(point.at.x_m, point.at.y_m);
    EXPECT_NEAR(distance_m(room, {0, 0, std::atan2(point.at.y_m, point.at.x_m)}), range_m, 2e-4)
        << "unless a nearer wall hides it";
  }
}

TEST(Surface, OfAMirroredScanIsTheMirrorImage) {
  const Scan scan = clean_scan(clean());
  const std::vector<SurfacePoint> points = surface_of(scan, {}), image = surface_of(mirrored(scan), {});
  ASSERT_EQ(points.size(), image.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_DOUBLE_EQ(points[i].at.x_m, image[i].at.x_m);
    EXPECT_DOUBLE_EQ(points[i].at.y_m, -image[i].at.y_m);
    EXPECT_EQ(points[i].on_line, image[i].on_line);
  }
}

}  // namespace
}  // namespace astro::lidar
