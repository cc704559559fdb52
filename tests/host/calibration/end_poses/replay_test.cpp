#include "host/calibration/end_poses/replay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/calibration/motion/wheel_factors.hpp"
#include "tests/host/calibration/end_poses/square_runs.hpp"

namespace astro::calibration {
namespace {

using namespace test;
using std::numbers::pi;

TEST(Replay, ARobotThatKnowsItselfComesBackToItsStart) {
  for (const Sense sense : {Sense::cw, Sense::ccw}) {
    const EndPose error = replay_square(kSide_m, sense, kThesisRobot, kThesisRobot);
    EXPECT_NEAR(error.x_m, 0, 1e-14);  // rounding of a 12 m path
    EXPECT_NEAR(error.y_m, 0, 1e-14);
    EXPECT_NEAR(error.theta_rad, 0, 1e-14);
  }
}

TEST(Replay, FineStepsOfAUnicycleEndInTheSamePlace) {
  const WheelFactors truth{1.01, 0.985, 0.301};
  const auto roll = [&](EndPose& pose, double right_m, double left_m) {
    constexpr int kSteps = 200000;
    const double turn = (right_m - left_m) / truth.b_m / kSteps;
    const double step_m = (right_m + left_m) / 2 / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      pose.x_m += step_m * std::cos(pose.theta_rad + turn / 2);
      pose.y_m += step_m * std::sin(pose.theta_rad + turn / 2);
      pose.theta_rad += turn;
    }
  };
  EndPose stepped;
  const double spin_m = kNominal.b_m * pi / 4;
  for (int leg = 0; leg < 4; ++leg) {
    roll(stepped, kSide_m * truth.c_r, kSide_m * truth.c_l);
    roll(stepped, -spin_m * truth.c_r, spin_m * truth.c_l);
  }
  const EndPose exact = replay_square(kSide_m, Sense::cw, kNominal, truth);
  EXPECT_NEAR(stepped.x_m, exact.x_m,
              1e-9);  // midpoint steps: leg * turn^2 / 24 per step, and the rounding of 1.6e6 sums
  EXPECT_NEAR(stepped.y_m, exact.y_m, 1e-9);
  EXPECT_NEAR(stepped.theta_rad + 2 * pi, exact.theta_rad, 1e-9);
}

TEST(Replay, ExchangingWheelsAndSenseMirrorsTheEndPose) {
  const WheelFactors mirrored{kThesisRobot.c_l, kThesisRobot.c_r, kThesisRobot.b_m};
  const EndPose cw = replay_square(kSide_m, Sense::cw, kNominal, kThesisRobot);
  const EndPose ccw = replay_square(kSide_m, Sense::ccw, kNominal, mirrored);
  EXPECT_NEAR(ccw.x_m, cw.x_m, 1e-14);
  EXPECT_NEAR(ccw.y_m, -cw.y_m, 1e-14);
  EXPECT_NEAR(ccw.theta_rad, -cw.theta_rad, 1e-14);
}

TEST(Replay, AClosedSquareIsBlindToACommonScale) {
  // Larger wheels on a wider base drive a larger square that closes as well: no end pose tells.
  const WheelFactors larger{1.02, 1.02, 1.02 * kNominal.b_m};
  EXPECT_NEAR(replay_E_max_syst_m(kSide_m, kNominal, larger), 0, 1e-14);
}

TEST(Replay, HeadingErrorIsFourSpinsAndFourLegs) {
  const double alpha = pi / 2 * (1 - 1 / kThesis_E_b);
  const double beta = kSide_m * (kThesisRobot.c_r - kThesisRobot.c_l) / kThesisRobot.b_m;
  EXPECT_NEAR(replay_square(kSide_m, Sense::ccw, kNominal, kThesisRobot).theta_rad, 4 * (beta - alpha),
              1e-14);
  EXPECT_NEAR(replay_square(kSide_m, Sense::cw, kNominal, kThesisRobot).theta_rad, 4 * (beta + alpha), 1e-14);
}

TEST(Replay, TheSwappedPairOfTheThesisMakesItsRobotWorse) {
  const WheelFactors swapped{kThesisRobot.c_l, kThesisRobot.c_r, kThesisRobot.b_m};
  const double uncalibrated_m = replay_E_max_syst_m(kSide_m, kNominal, kThesisRobot);
  const double swapped_m = replay_E_max_syst_m(kSide_m, swapped, kThesisRobot);
  const double right_m = replay_E_max_syst_m(kSide_m, kThesisRobot, kThesisRobot);
  EXPECT_NEAR(uncalibrated_m, 0.419, 0.0005);  // half the last printed millimetre
  EXPECT_NEAR(swapped_m, 0.762, 0.0005);
  EXPECT_NEAR(right_m, 0, 1e-14);
}

}  // namespace
}  // namespace astro::calibration
