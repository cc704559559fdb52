#include "host/simulation/study/trial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/base/require_positive.hpp"
#include "host/simulation/study/kinematic_source.hpp"
#include "host/simulation/study/limits.hpp"
#include "host/simulation/study/synthetic_drive.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::simulation::study {
namespace {

using calibration::WheelFactors;
using support::Tells;

TEST(StudyErrors, OfTheTruthAreNone) {
  const TrialSetup setup;
  for (const double error : errors_of(setup.actual(), setup)) EXPECT_NEAR(error, 0, 1e-12);
}

TEST(StudyErrors, OfTheUncalibratedRobotAreThoseOfThePublishedTable) {
  const TrialSetup setup;
  const Errors errors = errors_of(setup.loaded(), setup);
  // Half of the last printed digit.
  EXPECT_NEAR(std::abs(errors[kE_d]), 41.6e-4, 0.05e-4);
  EXPECT_NEAR(std::abs(errors[kB_over_S]), 47.9e-4, 0.05e-4);
  EXPECT_NEAR(std::abs(errors[kScale]), 50e-4, 0.5e-4);
  EXPECT_NEAR(errors[kE_max_m], 0.421, 0.0005);
  EXPECT_NEAR(errors[kTheta_rad], 0.175, 0.0005);
  EXPECT_NEAR(errors[kLine_m], 0.722, 0.0005);
}

TEST(StudyErrors, OfACommonScaleAloneAreALineThatEndsTooFar) {
  const TrialSetup setup;
  const WheelFactors actual = setup.actual();
  const WheelFactors unscaled{actual.c_r / setup.scale, actual.c_l / setup.scale, actual.b_m / setup.scale};
  const Errors errors = errors_of(unscaled, setup);
  EXPECT_NEAR(errors[kScale], 1 - setup.scale, 1e-12);
  EXPECT_NEAR(errors[kE_d], 0, 1e-12);
  EXPECT_NEAR(errors[kB_over_S], 0, 1e-12);
  EXPECT_NEAR(errors[kE_max_m], 0, 1e-12) << "a closed square is blind to it";
  EXPECT_NEAR(errors[kLine_m], 10 * (setup.scale - 1), 1e-12);
}

TEST(StudySetup, RefusesWhatCannotBeDriven) {
  const auto told = [](auto change) {
    TrialSetup setup;
    change(setup);
    return support::told_by([&] { setup.check(); });
  };
  EXPECT_THAT(told([](TrialSetup& s) { s.side_m = 0; }),
              Tells(SettingProblem::not_positive, "the side of the square in metres", "0"));
  EXPECT_THAT(told([](TrialSetup& s) { s.trials = 0; }),
              Tells(LimitProblem::out_of_range, "the number of trials", "0"));
  EXPECT_THAT(told([](TrialSetup& s) { s.noise.K_m = std::nan(""); }),
              Tells(SettingProblem::not_positive, "the wheel slip K in metres", "nan"));
  EXPECT_THAT(told([](TrialSetup& s) {
                s.side_m = 1000;
                s.runs = 1000;
              }),
              Tells(LimitProblem::exceeds_memory, "7411"));
  EXPECT_THAT(told([](TrialSetup& s) { s.circles = 1001; }),
              Tells(LimitProblem::out_of_range, "the number of circles in each direction", "1001"));
  EXPECT_THAT(told([](TrialSetup& s) { s.circle_radius_m = 0; }),
              Tells(SettingProblem::not_positive, "the radius of the circles in metres", "0"));
  EXPECT_THAT(told([](TrialSetup& s) { s.e = 0.3; }),
              Tells(LimitProblem::out_of_range, "the curvature effect e", "0.3"));
  EXPECT_THAT(told([](TrialSetup& s) { s.windup_rad = -0.006; }),
              Tells(LimitProblem::out_of_range, "the wind-up in radians", "-0.006"));
  EXPECT_THAT(told([](TrialSetup& s) {
                s.circles = 1000;
                s.circle_radius_m = 1000;
              }),
              Tells(LimitProblem::exceeds_memory, "23271"));
}

TEST(StudySetup, DrivesHalfOfTheSquaresEachWayAndNoTwoAlike) {
  TrialSetup setup;
  setup.runs = 2;
  setup.side_m = 1;
  const auto drives = KinematicSource().of_trial(setup, 0).runs;
  ASSERT_EQ(drives.size(), 4U);
  EXPECT_EQ(drives[0].name, "square cw 1");
  EXPECT_EQ(drives[3].name, "square ccw 2");
  EXPECT_NE(drives[0].truth.back().x_m, drives[2].truth.back().x_m);
  EXPECT_NE(drives[0].truth.back().x_m, KinematicSource().of_trial(setup, 1).runs[0].truth.back().x_m);
}

TEST(StudySetup, DrivesCirclesAfterTheSquaresAndLeavesTheSquaresAsTheyAre) {
  TrialSetup setup;
  setup.runs = 1;
  setup.side_m = 1;
  setup.clock_known = false;
  const Drives squares = KinematicSource().of_trial(setup, 0);
  setup.circles = 2;
  const Drives drives = KinematicSource().of_trial(setup, 0);
  ASSERT_EQ(drives.runs.size(), 6U);
  EXPECT_EQ(drives.runs[2].name, "circle cw 1");
  EXPECT_EQ(drives.runs[5].name, "circle ccw 2");
  EXPECT_EQ(drives.end_errors.size(), 2U) << "a circle tells methods of end poses nothing";
  for (std::size_t run = 0; run < 2; ++run) {
    EXPECT_EQ(drives.runs[run].truth.back().x_m, squares.runs[run].truth.back().x_m);
    EXPECT_EQ(drives.runs[run].truth.back().time_s, squares.runs[run].truth.back().time_s);
    EXPECT_EQ(drives.end_errors[run].x_m, squares.end_errors[run].x_m);
  }
  // Two turns of a circle of 0.75 m.
  const calibration::WheelSample& end = drives.runs[3].wheels.back();
  EXPECT_NEAR((end.left_m + end.right_m) / 2, 3 * std::numbers::pi, 1e-9);
}

TEST(StudySetup, ASquareThatWindsUpHasTheEndErrorOfTheSquareAndNotOfTheLineBehindIt) {
  TrialSetup setup;
  setup.runs = 1;
  setup.noise = {1e-13, 1e-9, 1e-9};
  const Drives plain = KinematicSource().of_trial(setup, 0);
  setup.windup_rad = 0.006;
  const Drives wound = KinematicSource().of_trial(setup, 0);
  for (std::size_t run = 0; run < 2; ++run) {
    const calibration::EndPose &a = plain.end_errors[run], &b = wound.end_errors[run];
    // Each line begins 6 mrad off and lets go of that within 3 mm: it is 18 um aside.
    EXPECT_NEAR(b.x_m, a.x_m, 1e-4);
    EXPECT_NEAR(b.y_m, a.y_m, 1e-4);
    EXPECT_NEAR(std::abs(b.theta_rad - a.theta_rad), setup.windup_rad, 1e-5)
        << "what the last spin holds back";
    const calibration::WheelSample& end = wound.runs[run].wheels.back();
    EXPECT_NEAR((end.left_m + end.right_m) / 2, 4 * setup.side_m + kEndLine_m, 1e-9);
  }
}

TEST(StudyErrors, OfEAreAFigureOfTheirOwn) {
  TrialSetup setup;
  setup.e = 0.02;
  for (const double error : errors_of(setup.actual(), setup)) EXPECT_NEAR(error, 0, 1e-12);
  WheelFactors found = setup.actual();
  found.e = 0.025;
  const Errors errors = errors_of(found, setup);
  EXPECT_NEAR(errors[kCurvature], 0.005, 1e-12);
  EXPECT_EQ(errors[kLine_m], 0) << "a line has no curvature";
}

TEST(StudySetup, GivesEachRunAClockOfItsOwnOnlyIfItIsToBeEstimated) {
  TrialSetup setup;
  setup.runs = 1;
  setup.side_m = 1;
  EXPECT_EQ(KinematicSource().of_trial(setup, 0).runs[0].truth.front().time_s, 0);
  setup.clock_known = false;
  const auto drives = KinematicSource().of_trial(setup, 0).runs;
  EXPECT_NE(drives[0].truth.front().time_s, 0);
  EXPECT_NE(drives[0].truth.front().time_s, drives[1].truth.front().time_s);
}

}  // namespace
}  // namespace astro::simulation::study
