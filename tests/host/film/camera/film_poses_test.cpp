#include "host/film/camera/film_poses.hpp"

#include <gtest/gtest.h>

#include "tests/host/film/camera/synthetic_scene.hpp"

namespace astro::film {
namespace {

TEST(FilmPoses, AreInTheOrderOfTheirTimesAlsoIfPicturesAreStampedCloserThanTheirRows) {
  Scene scene = support::phone_scene();
  scene.readout_s = 0.02;
  std::vector<RobotTagSeen> seen;
  std::size_t overtakes = 0;
  double before_s = -1;
  for (const RobotSighting& one : support::seen_robot(scene, 300)) {
    const std::size_t i = seen.size();
    // Every tenth picture is stamped as if it had come just after the one before.
    const double pts_s = i % 10 == 9 ? seen.back().pts_s + 65e-6 : static_cast<double>(i) / 30;
    seen.push_back({pts_s, one.corners, 1});
    const double time_s = pts_s + row_delay_s(scene, one.corners);
    overtakes += time_s <= before_s ? 1 : 0;
    before_s = time_s;
  }
  ASSERT_GT(overtakes, 5U) << "the robot moves up the picture";
  const FilmPoses found = film_poses(scene, seen);
  EXPECT_GT(found.poses.size(), 200U);
  for (std::size_t i = 1; i < found.poses.size(); ++i)
    EXPECT_GT(found.poses[i].time_s, found.poses[i - 1].time_s);
}

}  // namespace
}  // namespace astro::film
