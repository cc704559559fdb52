#include "host/calibration/clock_search.hpp"

#include <gtest/gtest.h>

#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

Trajectory drive(double offset_s, double skew, bool headings = true) {
  study::DriveModel model = astro_drive();
  model.clock_offset_s = offset_s;
  model.clock_skew = skew;
  model.headings = headings;
  return study::synthetic_drive(study::square_course(1.7, Sense::cw), model, "run", kSeed);
}

// A start for the likelihood, which pulls in from a few tenths of a second: a bin of the search will do.
constexpr double kBin_s = 0.05;

TEST(ClockSearch, FindsASmallOffset) {
  const ClockFit fit = search_clock(drive(0.12, 0), 0.29, {});
  EXPECT_NEAR(fit.offset_s, 0.12, kBin_s);
  EXPECT_EQ(fit.skew, 0);
  EXPECT_GT(fit.correlation, 0.97);
}

TEST(ClockSearch, FindsAnyOffsetAndASlowClock) {
  const ClockFit fit = search_clock(drive(482.3, -0.0235), 0.29, {});
  EXPECT_NEAR(fit.offset_s, 482.3, kBin_s);
  EXPECT_NEAR(fit.skew, -0.0235, 0.006);  // 28 s long: a tenth of a second over half of it
  EXPECT_GT(fit.correlation, 0.97);
}

TEST(ClockSearch, WorksWithPositionsAlone) {
  EXPECT_NEAR(search_clock(drive(-7.7, 0, false), 0.29, {}).offset_s, -7.7, kBin_s);
}

TEST(ClockSearch, DoesNotMindAMirroredTruth) {
  Trajectory run = drive(3, 0);
  for (BodySample& sample : run.truth) {
    sample.y_m = -sample.y_m;
    sample.theta_rad = -sample.theta_rad;
  }
  EXPECT_NEAR(search_clock(run, 0.29, {}).offset_s, 3, kBin_s);
}

TEST(ClockSearch, IsAsFastForALongSteadyDriveAndKnowsItAgain) {
  // Ten minutes of one spin: nothing varies but its ends, and the square of its samples would take seconds.
  study::DriveModel model = astro_drive();
  const Trajectory run = study::synthetic_drive(study::spin_course(600), model, "run", kSeed);
  const ClockFit fit = search_clock(run, 0.29, {});
  EXPECT_NEAR(fit.offset_s, 0, 0.1);
  EXPECT_GT(fit.likeness, 0.95);
}

TEST(ClockSearch, FindsNothingInCommonWithAnotherDrive) {
  Trajectory run = drive(0, 0);
  run.truth = study::synthetic_drive({{study::Leg::Kind::rest, 0, 0, 11},
                                      {study::Leg::Kind::straight, 0.7, 0, 0},
                                      {study::Leg::Kind::rest, 0, 0, 16}},
                                     astro_drive(), "other", kSeed)
                  .truth;
  const ClockFit fit = search_clock(run, 0.29, {});
  EXPECT_LT(fit.correlation, 0.5);
  EXPECT_LT(fit.likeness, 0.9);
}

}  // namespace
}  // namespace astro::calibration
