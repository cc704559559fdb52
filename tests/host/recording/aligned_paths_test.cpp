#include "host/recording/aligned_paths.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "host/recording/end_error.hpp"
#include "tests/host/recording/support.hpp"

namespace astro::recording {
namespace {

using support::Drive;

Drive far_drive() {
  Drive drive;
  drive.odometry_frame = {3, -2, 1.5};
  drive.truth_frame = {-1, 4, -2.8};
  drive.odometry_end = {1.0, 0.2, 0.4};
  drive.truth_end = {1.1, 0.1, 0.3};
  return drive;
}

TEST(AlignedPaths, BothPathsStartAtTheOriginAndEndWhereTheyShould) {
  const AlignedPaths paths = align_paths(far_drive().run());
  ASSERT_EQ(paths.odometry.size(), 301U);
  ASSERT_EQ(paths.truth.size(), 301U);
  for (const auto* path : {&paths.odometry, &paths.truth}) {
    EXPECT_NEAR(path->front().pose.x_m, 0, 1e-12);
    EXPECT_NEAR(path->front().pose.y_m, 0, 1e-12);
    EXPECT_NEAR(path->front().pose.theta_rad, 0, 1e-12);
  }
  EXPECT_NEAR(paths.odometry.back().pose.x_m, 1.0, 1e-12);
  EXPECT_NEAR(paths.truth.back().pose.y_m, 0.1, 1e-12);
  EXPECT_NEAR(paths.truth.back().pose.theta_rad, 0.3, 1e-12);
  EXPECT_DOUBLE_EQ(paths.odometry.front().time_s, 0);
  EXPECT_NEAR(paths.odometry.back().time_s, 3, 1e-12);
}

TEST(AlignedPaths, TheErrorGrowsFromNothingToTheEndError) {
  const recording::Run run = far_drive().run();
  const AlignedPaths paths = align_paths(run);
  const Pose2 end = end_error(run);
  ASSERT_EQ(paths.error.size(), 300U) << "truth begins 1.2 ms after the first odometry sample";
  EXPECT_NEAR(paths.error.front().pose.x_m, 0, 1e-12);
  EXPECT_NEAR(paths.error.back().pose.x_m, end.x_m, 1e-12);
  EXPECT_NEAR(paths.error.back().pose.theta_rad, end.theta_rad, 1e-12);
  // Halfway both have gone half their way; truth is linear in time there, so interpolation is exact but for
  // the 1.2 ms that truth lags, 1.2e-3 / 2 of the way.
  EXPECT_NEAR(paths.error[149].pose.x_m, 0.05, 1e-3);
}

TEST(AlignedPaths, WhereTruthIsLostForLongThereIsNoError) {
  recording::Run run = far_drive().run();
  for (TruthSample& sample : run.truth) {
    sample.valid = sample.time_us < 6'000'000 || sample.time_us > 7'000'000;
  }
  run.truth[20].valid = false;  // a single frame is bridged
  const AlignedPaths paths = align_paths(run);
  int inside = 0;
  for (const PathPoint& point : paths.error) inside += point.time_s > 1.0 && point.time_s < 2.0 ? 1 : 0;
  EXPECT_EQ(inside, 0);
  EXPECT_EQ(paths.error.size(), 300U - 101U)
      << "odometry from 1.00 s to 2.00 s lies between the two valid ends";
}

TEST(AlignedPaths, ATruthSampleOfWhichOneCoordinateIsNoNumberIsNone) {
  const std::size_t all = align_paths(far_drive().run()).truth.size();
  for (double TruthSample::*coordinate : {&TruthSample::x_m, &TruthSample::y_m}) {
    recording::Run run = far_drive().run();
    run.truth[100].*coordinate = std::numeric_limits<double>::quiet_NaN();
    run.truth[101].*coordinate = std::numeric_limits<double>::infinity();
    const AlignedPaths paths = align_paths(run);
    EXPECT_EQ(paths.truth.size(), all - 2);
    for (const PathPoint& point : paths.truth)
      EXPECT_TRUE(std::isfinite(point.pose.x_m) && std::isfinite(point.pose.y_m));
    for (const PathPoint& point : paths.error)
      EXPECT_TRUE(std::isfinite(point.pose.x_m) && std::isfinite(point.pose.y_m));
  }
}

TEST(AlignedPaths, ErrorsOfHeadingStayWithinHalfATurn) {
  Drive drive = far_drive();
  drive.truth_end.theta_rad = 0.3 + 4 * std::numbers::pi;
  recording::Run run = drive.run();
  for (TruthSample& sample : run.truth) sample.theta_rad = wrapped_rad(sample.theta_rad);
  EXPECT_NEAR(align_paths(run).error.back().pose.theta_rad, -0.1, 1e-12);
}

TEST(AlignedPaths, ARunThatBeginsInMotionStartsAtItsFirstTruth) {
  recording::Run run = far_drive().run();
  run.odometry.erase(run.odometry.begin(), run.odometry.begin() + 100);
  run.truth.erase(run.truth.begin(), run.truth.begin() + 120);
  const AlignedPaths paths = align_paths(run);
  ASSERT_FALSE(paths.error.empty());
  EXPECT_NEAR(paths.truth.front().pose.x_m, 0, 1e-12);
  EXPECT_NEAR(paths.error.front().time_s, 0.21, 1e-9);
  EXPECT_NEAR(paths.error.front().pose.x_m, 0, 1e-2);  // one sample further on
}

TEST(AlignedPaths, WithoutTruthThereIsTheOdometryPathAlone) {
  recording::Run run = far_drive().run();
  run.truth.clear();
  const AlignedPaths paths = align_paths(run);
  EXPECT_EQ(paths.odometry.size(), 301U);
  EXPECT_NEAR(paths.odometry.back().pose.x_m, 1.0, 1e-12);
  EXPECT_TRUE(paths.truth.empty() && paths.error.empty());
  EXPECT_TRUE(align_paths({}).odometry.empty());
}

}  // namespace
}  // namespace astro::recording
