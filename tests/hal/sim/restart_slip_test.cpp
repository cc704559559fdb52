#include "hal/sim/restart_slip.hpp"

#include <gtest/gtest.h>

#include "tests/hal/sim/support.hpp"

namespace astro::sim {
namespace {

constexpr double kSlip_rad = 0.005;

/// All jumps during so many ticks of these wheel travels.
double moved(RestartSlip& slip, int ticks, double left_m, double right_m) {
  double sum_rad = 0;
  for (int i = 0; i < ticks; ++i) sum_rad += slip.advance(left_m, right_m);
  return sum_rad;
}
double stands(RestartSlip& slip, int ticks) { return moved(slip, ticks, 0, 0); }
double spins(RestartSlip& slip, double sense) { return moved(slip, 500, -sense * 2e-4, sense * 2e-4); }
double drives(RestartSlip& slip) { return moved(slip, 500, 2e-4, 2e-4); }

TEST(RestartSlip, ComesOnceAfterASpinAndASecondInTheSenseOfTheSpin) {
  for (const double sense : {1.0, -1.0}) {
    RestartSlip slip(kSlip_rad);
    EXPECT_EQ(spins(slip, sense), 0);
    EXPECT_EQ(stands(slip, 1000), 0);
    EXPECT_EQ(drives(slip), sense * kSlip_rad);
    stands(slip, 2000);
    EXPECT_EQ(drives(slip), 0) << "the last motion was a line";
  }
}

TEST(RestartSlip, ComesAfterEachSpinAlsoIfTheNextMotionIsASpin) {
  RestartSlip slip(kSlip_rad);
  for (const double sense : {1.0, 1.0, -1.0}) {
    spins(slip, sense);
    stands(slip, 1500);
    EXPECT_EQ(spins(slip, -sense), sense * kSlip_rad);
    stands(slip, 30);
  }
}

TEST(RestartSlip, DoesNotComeWithoutASecondOfStanding) {
  RestartSlip slip(kSlip_rad);
  spins(slip, 1);
  stands(slip, 999);
  EXPECT_EQ(drives(slip), 0);
}

TEST(RestartSlip, DoesNotComeAfterAnArc) {
  RestartSlip slip(kSlip_rad);
  moved(slip, 500, 0, 2e-4);  // about one wheel
  stands(slip, 2000);
  EXPECT_EQ(drives(slip), 0);
}

TEST(RestartSlip, ASmallCorrectionAfterTheSpinDoesNotHideIt) {
  RestartSlip slip(kSlip_rad);
  spins(slip, 1);
  stands(slip, 50);
  EXPECT_EQ(moved(slip, 10, 2e-5, 2e-5), 0);
  stands(slip, 1000);
  EXPECT_EQ(drives(slip), kSlip_rad);
}

TEST(RestartSlip, OfTheBoardTurnsTheRobotAndNotItsWheels) {
  Config config = ideal();
  config.restart_slip_rad = kSlip_rad;
  Board slipping(config), other(ideal());
  for (Board* board : {&slipping, &other}) {
    board->motors().drive({duty_for(-4), duty_for(4)});
    run_ms(*board, 500);
    board->motors().brake();
    run_ms(*board, 1500);
    board->motors().drive({duty_for(4), duty_for(4)});
    run_ms(*board, 500);
  }
  EXPECT_EQ(slipping.encoders().read().left, other.encoders().read().left);
  EXPECT_EQ(slipping.encoders().read().right, other.encoders().read().right);
  EXPECT_NEAR(slipping.truth().theta_rad - other.truth().theta_rad, kSlip_rad, 1e-12);  // roundings
}

}  // namespace
}  // namespace astro::sim
