#include "host/simulation/study/trial.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/simulation/study/kinematic_source.hpp"
#include "tests/host/calibration/end_poses/square_runs.hpp"

namespace astro::simulation::study {
namespace {

using calibration::WheelFactors;

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
  const auto message = [](auto change) {
    TrialSetup setup;
    change(setup);
    return calibration::test::error_of([&] { setup.check(); });
  };
  EXPECT_EQ(message([](TrialSetup& s) { s.side_m = 0; }),
            "the side of the square in metres is 0, and has to be a positive number");
  EXPECT_EQ(message([](TrialSetup& s) { s.trials = 0; }),
            "the number of trials is 0: it has to be 1 to 10 million");
  EXPECT_EQ(message([](TrialSetup& s) { s.noise.K_m = std::nan(""); }),
            "the wheel slip K in metres is nan, and has to be a positive number");
  EXPECT_EQ(message([](TrialSetup& s) {
              s.side_m = 1000;
              s.runs = 1000;
            }),
            "some 7411 hours of driving are more than fit into memory");
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
