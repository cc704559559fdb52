#include "host/recording/end_error.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <numbers>

#include "tests/host/recording/support.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::recording {
namespace {

using astro::support::ThrowsTelling;
using std::numbers::pi;
using support::Drive;

constexpr double kRounding = 1e-12;  // poses of some metres in double, a few operations

constexpr const char* kRun = "run square cw 3 (before)";

TEST(EndError, IsAbsoluteMinusOdometrySeenFromTheStart) {
  Drive drive;
  drive.odometry_end = {0.1, 0.2, 0.05};
  drive.truth_end = {0.4, -0.1, -0.03};
  const Pose2 error = end_error(drive.run());
  EXPECT_NEAR(error.x_m, 0.3, kRounding);
  EXPECT_NEAR(error.y_m, -0.3, kRounding);
  EXPECT_NEAR(error.theta_rad, -0.08, kRounding);
}

TEST(EndError, DoesNotDependOnWhereTheTwoFramesLie) {
  Drive drive;
  drive.odometry_end = {0.02, -0.01, 2 * pi + 0.01};
  drive.truth_end = {-0.25, 0.31, 2 * pi - 0.07};
  for (const double turn_rad : {0.0, 1.0, pi / 2, 3.1, -3.1, pi, -40.0}) {
    drive.truth_frame = {-4, 7, turn_rad};
    drive.odometry_frame = {2, 1, -2 * turn_rad + 0.3};
    const Pose2 error = end_error(drive.run());
    EXPECT_NEAR(error.x_m, -0.27, kRounding) << turn_rad;
    EXPECT_NEAR(error.y_m, 0.32, kRounding) << turn_rad;
    EXPECT_NEAR(error.theta_rad, -0.08, kRounding) << turn_rad;
  }
}

TEST(EndError, HeadingsMayWrapAnywhere) {
  Drive drive;
  drive.truth_frame.theta_rad = pi;  // the noise makes the wrapped heading jump between +pi and -pi
  drive.truth_end = {0, 0, 3.0};
  drive.odometry_end = {0, 0, -3.0};
  drive.noise_rad = 1e-3;
  recording::Run run = drive.run();
  for (TruthSample& sample : run.truth) sample.theta_rad = wrapped_rad(sample.theta_rad);
  // 45 samples at each end: 1e-3 * sqrt(2 / 45) = 2e-4 is one sigma.
  EXPECT_NEAR(end_error(run).theta_rad, 6.0 - 2 * pi, 5 * 2.2e-4);
}

TEST(EndError, NoiseOfTruthAveragesOut) {
  Drive drive;
  drive.truth_end = {0.2, 0.1, 0.02};
  drive.truth_frame = {1, 1, 0.7};
  drive.noise_m = 1e-3;
  double square_sum_m2 = 0;
  constexpr int kRuns = 200;
  for (drive.seed = 1; drive.seed <= kRuns; ++drive.seed) {
    const Pose2 error = end_error(drive.run());
    square_sum_m2 += (error.x_m - 0.2) * (error.x_m - 0.2);
  }
  // Means of the samples between settling and the ends: 45 at the start, 45 at the end (0.5 s at 100 Hz less
  // 50 ms; the truth's offset of 1.2 ms drops one). The rms over 200 runs scatters by 5 %; 4 sigma are 20 %.
  EXPECT_NEAR(std::sqrt(square_sum_m2 / kRuns), 1e-3 * std::sqrt(2.0 / 45), 0.2 * 1e-3 * std::sqrt(2.0 / 45));
}

TEST(EndError, FlickeringAndWrappingCountsAreStillStandingStill) {
  Drive drive;
  drive.truth_end = {0.2, 0.1, 0.02};
  recording::Run run = drive.run();
  for (std::size_t i = 0; i < run.odometry.size(); ++i) {
    OdometrySample& sample = run.odometry[i];
    sample.left_counts = static_cast<std::int32_t>(static_cast<std::uint32_t>(sample.left_counts) +
                                                   0x7FFFFFFFU + static_cast<std::uint32_t>(i % 2));
  }
  EXPECT_NEAR(end_error(run).x_m, 0.2, 1e-9);
}

TEST(EndError, InvalidTruthIsLeftOut) {
  Drive drive;
  drive.truth_end = {0.2, 0.1, 0.02};
  recording::Run run = drive.run();
  for (std::size_t i = 0; i < run.truth.size(); i += 2) {
    run.truth[i] = {run.truth[i].time_us, 1e9, std::numeric_limits<double>::quiet_NaN(), 5, false};
  }
  EXPECT_NEAR(end_error(run).x_m, 0.2, kRounding);
}

TEST(EndError, OneSampleAtEachEndIsEnoughAsFromATapeMeasure) {
  Drive drive;
  recording::Run run = drive.run();
  run.truth = {{run.odometry.front().time_us, 0, 0, 0, true},
               {run.odometry.back().time_us, 0.25, -0.5, std::numeric_limits<double>::quiet_NaN(), true}};
  const Pose2 error = end_error(run);
  EXPECT_EQ(error.x_m, 0.25);
  EXPECT_EQ(error.y_m, -0.5);
  EXPECT_TRUE(std::isnan(error.theta_rad)) << "no heading was measured";
}

TEST(EndError, RefusalsNameTheRunAndTheEnd) {
  const recording::Run good = Drive{}.run();
  recording::Run run = good;
  for (TruthSample& sample : run.truth) sample.valid = sample.time_us < 7'000'000;
  const auto end = [&] { end_error(run); };
  EXPECT_THAT(end, ThrowsTelling(EndProblem::no_truth, kRun, "end"));
  run = good;
  for (TruthSample& sample : run.truth) sample.valid = sample.time_us > 7'000'000;
  EXPECT_THAT(end, ThrowsTelling(EndProblem::no_truth, kRun, "start"));
  run = good;
  for (TruthSample& sample : run.truth) sample.theta_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(end, ThrowsTelling(EndProblem::no_heading, kRun));
  run.truth.clear();
  EXPECT_THAT(end, ThrowsTelling(EndProblem::no_truth, kRun, "start"));
  EXPECT_THAT([&] { ends_of(run, "before/cw-3"); },
              ThrowsTelling(EndProblem::no_truth, "before/cw-3", "start"));
  run.odometry.clear();
  EXPECT_THAT(end, ThrowsTelling(EndProblem::no_odometry, kRun));
}

TEST(EndError, StandstillIsRequiredAtBothEnds) {
  recording::Run run = Drive{}.run();
  const auto end = [&] { end_error(run); };
  run.odometry.erase(run.odometry.begin(), run.odometry.begin() + 45);
  EXPECT_THAT(end, ThrowsTelling(EndProblem::no_rest, kRun, "start"));
  run = Drive{}.run();
  run.odometry.resize(run.odometry.size() - 45);
  EXPECT_THAT(end, ThrowsTelling(EndProblem::no_rest, kRun, "end"));
  run = Drive{}.run();
  for (OdometrySample& sample : run.odometry) sample.left_counts = sample.right_counts = 5;
  EXPECT_THAT(end, ThrowsTelling(EndProblem::never_moves, kRun));
}

}  // namespace
}  // namespace astro::recording
