#include "host/commands/shared/path_progress.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace astro::commands {
namespace {

recording::OdometrySample at(double x_m, double y_m, double theta_rad) {
  recording::OdometrySample sample;
  sample.x_m = x_m;
  sample.y_m = y_m;
  sample.theta_rad = theta_rad;
  return sample;
}

TEST(PathProgress, GoesFromNothingToAllAlongALine) {
  PathProgress way(robot::line(2));
  EXPECT_EQ(way.fraction(), 0);
  for (int i = 0; i <= 20; ++i) {
    way.moved_to(at(0.1 * i, 0, 0));
    EXPECT_NEAR(way.fraction(), 0.05 * i, 1e-12);
  }
}

TEST(PathProgress, CountsBackwardsWayAndTurnsOnTheSpot) {
  PathProgress back(robot::line(-1));
  back.moved_to(at(0, 0, 0));
  back.moved_to(at(-0.5, 0, 0));
  EXPECT_NEAR(back.fraction(), 0.5, 1e-12);

  PathProgress turn(robot::spin(-0.25));
  turn.moved_to(at(0, 0, 0));
  turn.moved_to(at(0, 0, -std::numbers::pi / 4));
  EXPECT_NEAR(turn.fraction(), 0.5, 1e-12);
}

TEST(PathProgress, IsNeverAheadOfASegmentThatIsNotDone) {
  PathProgress way(robot::square(1, Sense::ccw));
  way.moved_to(at(0, 0, 0));
  way.moved_to(at(5, 0, 0));  // the odometry is far away
  const double at_corner = way.fraction();
  EXPECT_LT(at_corner, 0.25);
  EXPECT_EQ(way.done(), 0U);
  way.segment_done(1);
  EXPECT_EQ(way.fraction(), at_corner);
}

TEST(PathProgress, IsAllOnceTheLastSegmentIsDoneHoweverTheOdometryDrifted) {
  PathProgress way(robot::square(1, Sense::ccw));
  way.moved_to(at(0, 0, 0));
  for (std::uint16_t tag = 1; tag <= 8; ++tag) way.segment_done(tag);
  EXPECT_EQ(way.fraction(), 1);
}

TEST(PathProgress, OfAWayOfNoLengthIsAll) { EXPECT_EQ(PathProgress(robot::line(0)).fraction(), 1); }

}  // namespace
}  // namespace astro::commands
