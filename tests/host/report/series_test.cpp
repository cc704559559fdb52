#include "host/report/series.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/host/report/example_input.hpp"

namespace astro::report {

/// A quarter turn to the left at 1 m radius, seen by odometry and by a tracker whose frame lies elsewhere.
recording::Run quarter_turn(double tracker_yaw_rad) {
  recording::Run run;
  const double c = std::cos(tracker_yaw_rad), s = std::sin(tracker_yaw_rad);
  for (int i = 0; i <= 100; ++i) {
    const double a = i * std::acos(-1.0) / 200, x = std::sin(a), y = 1 - std::cos(a);
    run.odometry.push_back({.time_us = i * 10'000, .x_m = x, .y_m = y, .theta_rad = a});
    run.truth.push_back({.time_us = i * 10'000,
                         .x_m = 4 + c * x - s * y,
                         .y_m = -2 + s * x + c * y,
                         .theta_rad = tracker_yaw_rad + a});
  }
  return run;
}

TEST(ReportSeries, DoNotDependOnWhereTheTrackersFrameLies) {
  for (const double yaw_rad : {0.0, 1.0, -3.0, 40.0}) {
    for (const PathPoint& p : align(quarter_turn(yaw_rad))) {
      EXPECT_NEAR(p.truth_x_m, p.odometry_x_m, 1e-12);
      EXPECT_NEAR(p.truth_y_m, p.odometry_y_m, 1e-12);
      EXPECT_NEAR(p.truth_theta_rad, p.odometry_theta_rad, 1e-12);
    }
  }
}

TEST(ReportSeries, InterpolateTruthBetweenItsSamples) {
  recording::Run run;
  run.odometry = {{.time_us = 0}, {.time_us = 5'000}, {.time_us = 20'000}};
  run.truth = {{.time_us = 0}, {.time_us = 20'000, .x_m = 0.4, .theta_rad = 0.8}};
  const auto points = align(run);
  EXPECT_DOUBLE_EQ(points[1].truth_x_m, 0.1);
  EXPECT_DOUBLE_EQ(points[1].truth_theta_rad, 0.2);
}

TEST(ReportSeries, LeaveAGapWhereTheTrackerLostTheRobot) {
  auto run = quarter_turn(0.5);
  for (std::size_t i = 40; i < 50; ++i) run.truth[i].valid = false;
  run.truth.erase(run.truth.begin() + 60, run.truth.begin() + 90);  // silent for 0.3 s
  const auto points = align(run);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool gap = (i >= 40 && i < 50) || (i >= 60 && i < 90);
    EXPECT_EQ(std::isnan(points[i].truth_x_m), gap) << "at sample " << i;
  }
}

TEST(ReportSeries, StartWhereTheTrackerFirstSawTheRobot) {
  auto run = quarter_turn(0.5);
  run.truth.erase(run.truth.begin(), run.truth.begin() + 10);
  const auto points = align(run);
  EXPECT_TRUE(std::isnan(points[9].truth_x_m));
  EXPECT_DOUBLE_EQ(points[10].truth_x_m, 0);
  EXPECT_DOUBLE_EQ(points[10].odometry_x_m, 0);
  EXPECT_NEAR(points.back().truth_x_m, points.back().odometry_x_m, 1e-12);
}

TEST(ReportSeries, KeepTheOdometryOfARunWithoutTruth) {
  auto run = quarter_turn(0);
  run.truth.clear();
  EXPECT_NEAR(align(run).back().odometry_x_m, 1, 1e-12);
  run.odometry.clear();
  EXPECT_TRUE(align(run).empty());
}

TEST(ReportSeries, KeepBothEndsWhenTheyAreThinned) {
  const auto points = align(quarter_turn(0));
  for (const std::size_t most : {2U, 3U, 7U, 100U, 101U, 1000U}) {
    const auto kept = thin(points, most);
    EXPECT_EQ(kept.size(), std::min<std::size_t>(most, 101));
    EXPECT_EQ(kept.front().time_s, 0);
    EXPECT_EQ(kept.back().time_s, points.back().time_s);
  }
}

}  // namespace astro::report
