#include "host/calibration/preparation/courses.hpp"

#include <gtest/gtest.h>

#include "host/calibration/preparation/preparation.hpp"
#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

std::vector<int> courses_of(const std::vector<Trajectory>& runs) {
  return find_courses(prepare(runs, astro_drive().loaded, true, Density::independent).runs);
}

TEST(Courses, AreRepeatedBySquaresOfOneSizeDrivenTheSameWayRound) {
  std::vector<Trajectory> runs = squares(astro_drive(), 4, 2);
  for (Trajectory& run : squares(astro_drive(), 1, 3)) runs.push_back(std::move(run));
  EXPECT_EQ(courses_of(runs), (std::vector{0, 1, 0, 1, 2}));
}

TEST(Courses, OfDifferentSessionsAreDifferent) {
  std::vector<Trajectory> runs = squares(astro_drive(), 4, 2);
  runs[2].session = runs[3].session = "tuesday";
  EXPECT_EQ(courses_of(runs), (std::vector{0, 1, 2, 3}));
}

}  // namespace
}  // namespace astro::calibration
