#include "host/calibration/preparation/courses.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace astro::calibration {
namespace {

constexpr double kSame = 0.05;  // of the path

struct Course {
  int session = 0;
  double path_m = 0;
  double turn_m = 0;  // way of the right wheel less that of the left one
};

Course course_of(const PreparedRun& run) {
  const WheelSample &first = run.source->wheels.front(), &last = run.source->wheels.back();
  return {run.session, run.path_m.back(), (last.right_m - first.right_m) - (last.left_m - first.left_m)};
}

bool are_equal(const Course& a, const Course& b) {
  const double tolerance_m = kSame * std::max(a.path_m, b.path_m);
  return a.session == b.session && std::abs(a.path_m - b.path_m) <= tolerance_m &&
         std::abs(a.turn_m - b.turn_m) <= tolerance_m;
}

}  // namespace

std::vector<int> find_courses(std::span<const PreparedRun> runs) {
  std::vector<Course> courses;
  std::vector<int> numbers;
  for (const PreparedRun& run : runs) {
    const Course course = course_of(run);
    const auto known = std::find_if(courses.begin(), courses.end(),
                                    [&](const Course& other) { return are_equal(course, other); });
    numbers.push_back(static_cast<int>(known - courses.begin()));
    if (known == courses.end()) courses.push_back(course);
  }
  return numbers;
}

}  // namespace astro::calibration
