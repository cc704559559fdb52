#include "host/report/figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/recording/end_error.hpp"
#include "tests/host/report/example_input.hpp"

namespace astro::report {
namespace {

recording::Run one_square() { return example_run("square", Sense::ccw, 1, 57, 4e-3, 3); }

TEST(ReportSeries, HaveAPointForEverySampleOfOdometry) {
  const auto run = one_square();
  const auto points = series_of(run);
  ASSERT_EQ(points.size(), run.odometry.size());
  EXPECT_EQ(points.front().time_s, 0);
  EXPECT_NEAR(points.back().time_s, 57, 1e-9);
}

TEST(ReportSeries, EndWhereTheRunsEndErrorSaysThatItEnded) {
  const auto run = one_square();
  const auto error = recording::end_error(run);
  const auto points = series_of(run);
  // Truth stops 3 ms before the last odometry sample, so the last error belongs to the sample before it.
  const auto& last = points[points.size() - 2].error;
  EXPECT_NEAR(last.x_m, error.x_m, 1e-12);
  EXPECT_NEAR(last.y_m, error.y_m, 1e-12);
  EXPECT_NEAR(last.theta_rad, error.theta_rad, 1e-12);
}

TEST(ReportSeries, LeaveAGapWhereTheTrackerLostTheRobot) {
  auto run = one_square();
  const std::size_t lost = 1000, found = 1050;  // a second, far longer than truth is interpolated over
  for (std::size_t i = lost; i < found; ++i) run.truth[i].valid = false;
  const auto points = series_of(run);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    // Truth sample i is 3 ms older than odometry sample i, so a point needs the truth samples i and i + 1.
    const bool gap = i + 1 >= lost && i < found;
    EXPECT_EQ(std::isnan(points[i].error.x_m), gap) << "at sample " << i;
  }
}

TEST(ReportSeries, KeepTheOdometryOfARunWithoutTruth) {
  auto run = one_square();
  run.truth.clear();
  const auto points = series_of(run);
  EXPECT_EQ(points.size(), run.odometry.size());
  EXPECT_TRUE(std::all_of(points.begin(), points.end(), [](auto& p) { return std::isnan(p.error.x_m); }));
  run.odometry.clear();
  EXPECT_TRUE(series_of(run).empty());
}

TEST(ReportSeries, KeepBothEndsWhenTheyAreThinned) {
  const auto points = series_of(one_square());
  for (const std::size_t most : {2U, 3U, 7U, 100U, 1500U, 100'000U}) {
    const auto kept = thin(points, most);
    EXPECT_EQ(kept.size(), std::min(most, points.size()));
    EXPECT_EQ(kept.front().time_s, 0);
    EXPECT_EQ(kept.back().time_s, points.back().time_s);
  }
}

}  // namespace
}  // namespace astro::report
