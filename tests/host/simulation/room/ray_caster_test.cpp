#include "host/simulation/room/ray_caster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace astro::simulation {
namespace {

constexpr double kPi = std::numbers::pi;

double from(const Room& room, const Point2& origin, double direction_rad) {
  return RayCaster(room).distance_m(origin, std::cos(direction_rad), std::sin(direction_rad));
}

/// Within a box each coordinate reaches its wall at a time of its own, and the ray ends at the first.
double to_box_m(const Point2& least, const Point2& most, const Point2& origin, double direction_rad) {
  const double c = std::cos(direction_rad), s = std::sin(direction_rad);
  const double x_m = (c > 0 ? most.x_m - origin.x_m : least.x_m - origin.x_m) / c;
  const double y_m = (s > 0 ? most.y_m - origin.y_m : least.y_m - origin.y_m) / s;
  return std::min(x_m, y_m);
}

TEST(RayCaster, EndsAtTheWallsOfABoxFromWhereverItStarts) {
  constexpr unsigned kSeed = 11;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  const Point2 least{-2, -1}, most{5, 3};
  const Room room = rectangular_room(least, most);
  std::uniform_real_distribution<double> x(-1.9, 4.9), y(-0.9, 2.9), angle(-kPi, kPi);
  for (int i = 0; i < 1000; ++i) {
    const Point2 origin{x(random), y(random)};
    const double direction_rad = angle(random);
    // A direction almost along a wall divides by a small number, so the tolerance is that of seven metres over 1e-3.
    EXPECT_NEAR(from(room, origin, direction_rad), to_box_m(least, most, origin, direction_rad), 1e-9);
  }
}

TEST(RayCaster, SeesTheNearerOfTwoWallsFromBothSides) {
  const Room room{{{{2, -1}, {2, 1}}, {{3, -1}, {3, 1}}}};
  EXPECT_DOUBLE_EQ(from(room, {0, 0}, 0), 2);
  EXPECT_DOUBLE_EQ(from(room, {5, 0}, kPi), 2);
}

TEST(RayCaster, SeesNothingBehindItBesideAWallOrAlongOne) {
  const Room room{{{{2, -1}, {2, 1}}}};
  EXPECT_TRUE(std::isinf(from(room, {0, 0}, kPi)));
  EXPECT_TRUE(std::isinf(from(room, {0, 1.5}, 0)));
  EXPECT_TRUE(std::isinf(RayCaster(room).distance_m({2, -3}, 0, 1)));  // exactly in the wall's own line
  EXPECT_TRUE(std::isinf(RayCaster(Room{}).distance_m({0, 0}, 1, 0)));
}

TEST(RayCaster, SeesAPersonBeforeTheWallAndNotBehindIt) {
  Room room{{{{4, -1}, {4, 1}}}, {{.path = {{2, 0}}, .radius_m = 0.25}}};
  EXPECT_DOUBLE_EQ(from(room, {0, 0}, 0), 1.75);
  EXPECT_DOUBLE_EQ(from(room, {0, 0.5}, 0), 4);    // past the person
  EXPECT_DOUBLE_EQ(from(room, {2.1, 0}, kPi), 0);  // inside
  room.people.front().path = {{6, 0}};
  EXPECT_DOUBLE_EQ(from(room, {0, 0}, 0), 4);
}

TEST(RayCaster, MovesPeopleAlongTheirPathAndBack) {
  const Room room{{}, {{.path = {{2, 0}, {2, 3}}, .speed_mps = 1.5, .radius_m = 0.5}}};
  RayCaster rays(room);
  for (const double returned_s : {0.0, 4.0, 400.0}) {
    rays.move_people(returned_s);
    EXPECT_NEAR(rays.distance_m({0, 0}, 1, 0), 1.5, 1e-9);
    rays.move_people(returned_s + 2);  // at the far end
    EXPECT_TRUE(std::isinf(rays.distance_m({0, 0}, 1, 0)));
    EXPECT_NEAR(rays.distance_m({0, 3}, 1, 0), 1.5, 1e-9);
  }
}

TEST(Walker, WalksAtItsSpeedRoundCorners) {
  const Walker walker{.path = {{0, 0}, {1, 0}, {1, 2}}, .speed_mps = 0.5};
  Point2 before = walker.at(0);
  double walked_m = 0;
  for (int i = 1; i <= 120; ++i) {  // there and back in 12 s
    const Point2 now = walker.at(0.1 * i);
    walked_m += std::hypot(now.x_m - before.x_m, now.y_m - before.y_m);
    before = now;
  }
  EXPECT_NEAR(walked_m, 6, 1e-9);
  EXPECT_NEAR(before.x_m, 0, 1e-9);
  EXPECT_NEAR(before.y_m, 0, 1e-9);
}

TEST(Walker, OfOnePointStands) {
  const Walker walker{.path = {{3, 4}}};
  EXPECT_DOUBLE_EQ(walker.at(17.5).x_m, 3);
  EXPECT_DOUBLE_EQ(walker.at(17.5).y_m, 4);
}

}  // namespace
}  // namespace astro::simulation
