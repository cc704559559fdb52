#include "host/lidar/nearest_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace astro::lidar {
namespace {

TEST(NearestPoints, AreThoseOfALookAtAllOfThem) {
  std::mt19937_64 random(4);  // any seed
  std::uniform_real_distribution<double> place(-3, 3);
  for (const int count : {0, 1, 5, 6, 7, 40, 400}) {
    std::vector<SurfacePoint> points;
    for (int i = 0; i < count; ++i) points.push_back({{place(random), place(random)}, {}, false});
    const NearestPoints tree(points);
    for (int search = 0; search < 200; ++search) {
      const Point2 to{place(random), place(random)};
      double least_m = 0.5;
      bool any = false;
      for (const SurfacePoint& point : points)
        if (const double m = std::hypot(point.at.x_m - to.x_m, point.at.y_m - to.y_m); m < least_m) {
          least_m = m;
          any = true;
        }
      const SurfacePoint* const found = tree.nearest(to, 0.5);
      ASSERT_EQ(found != nullptr, any);
      if (any) {
        EXPECT_DOUBLE_EQ(std::hypot(found->at.x_m - to.x_m, found->at.y_m - to.y_m), least_m);
      }
    }
  }
}

TEST(NearestPoints, CopeWithPointsInOnePlaceAndOnOneLine) {
  const NearestPoints same(std::vector<SurfacePoint>(100, {{1, 2}, {}, false}));
  EXPECT_NE(same.nearest({1, 2.1}, 0.2), nullptr);
  EXPECT_EQ(same.nearest({1, 2.3}, 0.2), nullptr);
  std::vector<SurfacePoint> line;
  for (int i = 0; i < 100; ++i) line.push_back({{0, 0.1 * i}, {}, false});
  EXPECT_DOUBLE_EQ(NearestPoints(line).nearest({0.01, 4.31}, 1)->at.y_m, 4.3);
}

}  // namespace
}  // namespace astro::lidar
