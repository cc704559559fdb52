#include "hal/sim/motor.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/hal/sim/support.hpp"

namespace astro::sim {
namespace {

constexpr double kNoLoad_radps = 251.0 * 2.0 * std::numbers::pi / 60.0;

// Runs both motors at `volts` until nothing changes any more: 2 s are more than 40 time constants.
Board& settled(Board& board, double volts) {
  board.motors().drive({duty_for(volts), duty_for(volts)});
  run_ms(board, 2000);
  return board;
}

TEST(Motor, ConstantsArePhysical) {
  const Motor motor = motor_from(MotorSheet{}, 43.8);
  EXPECT_GT(motor.mesh_loss, 0.0);
  EXPECT_LT(motor.mesh_loss, 0.5) << "three gear stages of 80 % or better";
  EXPECT_GT(motor.coulomb_Nm, 0.0);
  EXPECT_GT(motor.viscous_Nmspr, 0.0);
  EXPECT_GT(motor.static_Nm, motor.coulomb_Nm) << "a wheel at rest sticks";
}

TEST(Motor, RunsAt251RpmAnd350mAWithoutLoad) {
  Board board(on_stand());
  settled(board, 12.0);
  EXPECT_NEAR(board.drivetrain().speed_radps()[0], kNoLoad_radps, 1e-6 * kNoLoad_radps);
  EXPECT_NEAR(board.drivetrain().speed_radps()[1], kNoLoad_radps, 1e-6 * kNoLoad_radps);
  EXPECT_NEAR(board.drivetrain().current_A()[0], 0.35, 1e-6);
}

TEST(Motor, RunsBackwardsAsFastAsForwards) {
  Board board(on_stand());
  settled(board, -12.0);
  EXPECT_NEAR(board.drivetrain().speed_radps()[0], -kNoLoad_radps, 1e-6 * kNoLoad_radps);
}

TEST(Motor, DrawsSevenAmperesWhenBlocked) {
  Board board(on_stand());
  board.set_load(Side::left, {.drag_Nm = 100.0});
  settled(board, 12.0);
  EXPECT_EQ(board.drivetrain().speed_radps()[0], 0.0);
  EXPECT_NEAR(board.drivetrain().current_A()[0], 7.0, 1e-9);
  EXPECT_NEAR(board.drivetrain().current_A()[1], 0.35, 1e-6) << "the other wheel runs free";
}

TEST(Motor, PullsItsStallTorqueAndNoMore) {
  for (const double sign : {1.0, -1.0}) {
    Board board(on_stand());
    settled(board, sign * 12.0);
    board.set_load(Side::right, {.torque_Nm = -sign * 1.75});
    run_ms(board, 2000);
    EXPECT_GT(sign * board.drivetrain().speed_radps()[1], 0.0);
    board.set_load(Side::right, {.torque_Nm = -sign * 1.77});
    run_ms(board, 2000);
    EXPECT_EQ(board.drivetrain().speed_radps()[1], 0.0);
  }
}

TEST(Motor, StaysBelowOneVoltAndStartsAboveIt) {
  for (const double sign : {1.0, -1.0}) {
    Board below(on_stand()), above(on_stand());
    EXPECT_TRUE(at_rest(settled(below, sign * 0.99)));
    EXPECT_EQ(below.encoders().read().left, 0);
    EXPECT_GT(sign * settled(above, sign * 1.01).drivetrain().speed_radps()[0], 0.1);
  }
}

// Kinetic friction is lower than static friction: once it turns it goes on below its starting voltage.
TEST(Motor, KeepsTurningBelowItsStartingVoltage) {
  Board board(on_stand());
  settled(board, 1.5);
  EXPECT_GT(settled(board, 0.8).drivetrain().speed_radps()[0], 0.1);
}

// w(t) = w_end (1 - exp(-t / tau)), tau = J / (B + (1 - m) Ke^2 / R). The first step starts from static
// friction and Euler steps of 250 us lag by step / (2 tau); together below 1 %.
TEST(Motor, RunsUpWithItsMechanicalTimeConstant) {
  const Motor motor = motor_from(MotorSheet{}, 43.8);
  const double through = 1.0 - motor.mesh_loss;
  const double tau_s = motor.inertia_kgm2 / (motor.viscous_Nmspr + through * motor.emf_Vspr * motor.emf_Vspr /
                                                                       motor.resistance_ohm);
  EXPECT_GT(tau_s, 0.02);
  EXPECT_LT(tau_s, 0.08);
  Board board(on_stand());
  board.motors().drive({32767, 32767});
  for (int ms = 1; ms <= 200; ++ms) {
    board.advance_tick();
    const double expected = kNoLoad_radps * (1.0 - std::exp(-1e-3 * ms / tau_s));
    ASSERT_NEAR(board.drivetrain().speed_radps()[0], expected, 0.01 * kNoLoad_radps) << ms << " ms";
  }
}

// Friction in the gear helps the brake: it takes its share of the torque on top, never off it. Speed falls by
// less than 3 % in the millisecond that is measured over.
TEST(Motor, BrakesWithGearLossOnTopOfItsTorque) {
  const Motor motor = motor_from(MotorSheet{}, 43.8);
  Board board(on_stand());
  settled(board, 12.0);
  board.motors().brake();
  board.advance_tick();
  const double electric_Nm = motor.emf_Vspr * motor.emf_Vspr * kNoLoad_radps / motor.resistance_ohm;
  const double friction_Nm = motor.coulomb_Nm + motor.viscous_Nmspr * kNoLoad_radps;
  const double expected = (electric_Nm * (1.0 + motor.mesh_loss) + friction_Nm) / motor.inertia_kgm2;
  EXPECT_NEAR((kNoLoad_radps - board.drivetrain().speed_radps()[0]) / 1e-3, expected, 0.03 * expected);
}

TEST(Motor, MismatchMakesOneSideFasterAtTheSameDuty) {
  Config config = on_stand();
  config.motor_mismatch = 0.02;
  Board board(config);
  settled(board, 12.0);
  const Pair speed = board.drivetrain().speed_radps();
  EXPECT_GT(speed[0], speed[1]) << "a higher constant turns slower";
  EXPECT_NEAR(speed[0] / speed[1], 1.02, 0.003) << "no-load speed goes nearly as 1 / Ke";
}

TEST(Wiring, ReversalsAndSwapsDoWhatTheySay) {
  const auto counts_after = [](const Wiring& wiring, hal::Duty duty) {
    Config config = on_stand();
    config.wiring = wiring;
    Board board(config);
    board.motors().drive(duty);
    run_ms(board, 100);
    return board.encoders().read();
  };
  const hal::EncoderCounts right_way = counts_after({}, {20000, 10000});
  EXPECT_GT(right_way.left, right_way.right);
  EXPECT_GT(right_way.right, 0);
  EXPECT_LT(counts_after({.left_motor_reversed = true}, {20000, 0}).left, 0);
  EXPECT_LT(counts_after({.right_motor_reversed = true}, {0, 20000}).right, 0);
  EXPECT_LT(counts_after({.left_encoder_reversed = true}, {20000, 0}).left, 0);
  EXPECT_LT(counts_after({.right_encoder_reversed = true}, {0, 20000}).right, 0);
  EXPECT_GT(counts_after({.motors_swapped = true}, {20000, 0}).right, 0);
  EXPECT_GT(counts_after({.encoders_swapped = true}, {20000, 0}).right, 0);
  const hal::EncoderCounts both =
      counts_after({.motors_swapped = true, .encoders_swapped = true}, {20000, 10000});
  EXPECT_EQ(both.left, right_way.left);
  EXPECT_EQ(both.right, right_way.right);
}

TEST(Wiring, AMotorWithoutALeadNeitherDrivesNorBrakes) {
  Config config = on_stand();
  config.wiring.left_motor_dead = true;
  Board board(config);
  board.motors().drive({20000, 20000});
  run_ms(board, 100);
  EXPECT_EQ(board.drivetrain().speed_radps()[0], 0.0);
  EXPECT_GT(board.drivetrain().speed_radps()[1], 0.0);
  board.motors().connect(Side::left);
  run_ms(board, 500);
  EXPECT_GT(board.drivetrain().speed_radps()[0], 0.0);
  board.motors().disconnect(Side::left);
  board.motors().brake();
  run_ms(board, 30);
  EXPECT_GT(board.drivetrain().speed_radps()[0], 3.0 * board.drivetrain().speed_radps()[1])
      << "only friction slows the one without a lead";
}

}  // namespace
}  // namespace astro::sim
