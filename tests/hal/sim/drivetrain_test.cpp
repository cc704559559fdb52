#include "hal/sim/drivetrain.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/hal/sim/support.hpp"

namespace astro::sim {
namespace {

// Acceleration at standstill, from the motor's torque less static friction (kinetic from the second step on),
// over the inertia that this motion sees; back-EMF takes at most 2.5 % in the first millisecond.
double acceleration(double volts_left, double volts_right, const Config& config) {
  Board board(config);
  board.motors().drive({duty_for(volts_left), duty_for(volts_right)});
  board.advance_tick();
  return board.drivetrain().speed_radps()[1] / 1e-3;
}

double expected_acceleration(double extra_kgm2) {
  const Motor motor = motor_from(MotorSheet{}, 43.8);
  const double torque_Nm =
      (1.0 - motor.mesh_loss) * motor.emf_Vspr * 12.0 / motor.resistance_ohm - motor.coulomb_Nm;
  return torque_Nm / (motor.inertia_kgm2 + extra_kgm2);
}

TEST(Drivetrain, EachMotionMeetsItsOwnInertia) {
  const double r_m = 0.036, b_m = 0.290, body_kg = 4.7, yaw_kgm2 = 0.0858;
  const double straight = expected_acceleration(r_m * r_m * body_kg / 2.0);
  const double spin = expected_acceleration(2.0 * r_m * r_m * yaw_kgm2 / (b_m * b_m));
  const double free = expected_acceleration(0.0);
  EXPECT_NEAR(acceleration(12, 12, ideal()), straight, 0.03 * straight);
  EXPECT_NEAR(acceleration(-12, 12, ideal()), spin, 0.03 * spin);
  EXPECT_NEAR(acceleration(12, 12, on_stand()), free, 0.03 * free);
}

TEST(Drivetrain, EqualWheelsDriveExactlyStraight) {
  Board board(ideal());
  board.motors().drive({15000, 15000});
  run_ms(board, 10000);
  EXPECT_GT(board.truth().x_m, 3.0);
  EXPECT_EQ(board.truth().y_m, 0.0);
  EXPECT_EQ(board.truth().theta_rad, 0.0);
}

TEST(Drivetrain, OppositeDutiesSpinOnTheSpot) {
  Board board(ideal());
  board.motors().drive({-15000, 15000});
  run_ms(board, 5000);
  EXPECT_GT(board.truth().theta_rad, 6.0);
  EXPECT_EQ(board.truth().x_m, 0.0);
  EXPECT_EQ(board.truth().y_m, 0.0);
}

TEST(Drivetrain, BlockedWheelBecomesThePivot) {
  Board board(ideal());
  board.set_load(Side::left, {.drag_Nm = 100.0});
  board.motors().drive({0, 20000});
  run_ms(board, 1000);
  EXPECT_EQ(board.encoders().read().left, 0);
  const Pose pose = board.truth();
  ASSERT_GT(pose.theta_rad, 1.0);
  // The left wheel's contact point stays where it was, 145 mm to the left of the start.
  EXPECT_NEAR(pose.x_m - 0.145 * std::sin(pose.theta_rad), 0.0, 1e-12);
  EXPECT_NEAR(pose.y_m + 0.145 * std::cos(pose.theta_rad), 0.145, 1e-12);
}

// One wheel pulls away; the body's mass lags and turns the idle wheel backwards, if that overcomes its
// friction: 0.06 N m against 0.15 at 4.7 kg, ten times that at 47 kg.
TEST(Drivetrain, BodyTurnsTheIdleWheelBackwardsOnceItIsHeavyEnough) {
  for (const double body_kg : {4.7, 47.0}) {
    Config config = ideal();
    config.body_kg = body_kg;
    Board board(config);
    board.motors().drive({0, 32767});
    run_ms(board, 5);
    if (body_kg < 10.0) {
      EXPECT_EQ(board.drivetrain().speed_radps()[0], 0.0);
    } else {
      EXPECT_LT(board.drivetrain().speed_radps()[0], 0.0);
    }
    EXPECT_GT(board.drivetrain().speed_radps()[1], 0.0);
  }
}

TEST(Drivetrain, BrakeStopsSoonerThanCoastAndZeroDutyBrakes) {
  const auto stop = [](auto&& how) {
    Board board(ideal());
    board.motors().drive({20000, 20000});
    run_ms(board, 1000);
    how(board.motors());
    return ms_to_rest(board);
  };
  const int braked = stop([](Motors& motors) { motors.brake(); });
  const int coasted = stop([](Motors& motors) { motors.coast(); });
  const int zero = stop([](Motors& motors) { motors.drive({0, 0}); });
  EXPECT_LT(braked, 200) << "a few time constants";
  EXPECT_GT(coasted, 2 * braked);
  EXPECT_LT(coasted, 5000);
  EXPECT_EQ(zero, braked);
}

TEST(Drivetrain, RestIsExactAndSilent) {
  Board board(Config{});
  eventful_drive(board);
  board.motors().drive({0, 0});
  ms_to_rest(board);
  const hal::EncoderCounts counts = board.encoders().read();
  const Pose pose = board.truth();
  for (int ms = 0; ms < 5000; ++ms) {
    board.advance_tick();
    ASSERT_TRUE(at_rest(board));
  }
  EXPECT_EQ(board.encoders().read().left, counts.left);
  EXPECT_EQ(board.encoders().read().right, counts.right);
  EXPECT_EQ(board.truth().x_m, pose.x_m);
  EXPECT_EQ(board.truth().theta_rad, pose.theta_rad);
}

TEST(Drivetrain, NeverGainsEnergyWithoutPower) {
  constexpr std::uint32_t kSeed = 20240611;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> volts(-12.0, 12.0), drag(0.0, 0.3);
  for (int trial = 0; trial < 200; ++trial) {
    Board board(Config{});
    board.motors().drive({duty_for(volts(random)), duty_for(volts(random))});
    run_ms(board, static_cast<int>(random() % 300));
    board.set_load(Side::left, {.drag_Nm = drag(random)});
    double energy_J = board.drivetrain().kinetic_energy_J();
    for (int ms = 0; ms < 300; ++ms) {
      if (random() % 20 == 0) board.motors().brake();
      if (random() % 20 == 0) board.motors().coast();
      if (ms == 0) board.motors().coast();
      board.advance_tick();
      const double now_J = board.drivetrain().kinetic_energy_J();
      ASSERT_LE(now_J, energy_J) << "seed " << kSeed << " trial " << trial << " at " << ms << " ms";
      energy_J = now_J;
    }
  }
}

// Work done by an outside torque on unpowered wheels cannot be less than the kinetic energy it leaves behind.
TEST(Drivetrain, OutsideWorkBoundsTheEnergyItLeaves) {
  Board board(ideal());
  board.set_load(Side::left, {.torque_Nm = 0.5});
  board.set_load(Side::right, {.torque_Nm = 0.4});
  double work_J = 0.0;
  Pair speed = board.drivetrain().speed_radps();
  for (int ms = 0; ms < 1000; ++ms) {
    board.advance_tick();
    const Pair now = board.drivetrain().speed_radps();
    work_J += 1e-3 * (0.5 * 0.5 * (speed[0] + now[0]) + 0.4 * 0.5 * (speed[1] + now[1]));
    speed = now;
    ASSERT_LE(board.drivetrain().kinetic_energy_J(), work_J * (1.0 + 1e-3)) << "1e-3: trapezoid over 1 ms";
  }
  EXPECT_GT(board.drivetrain().kinetic_energy_J(), 0.1);
}

// Pushed faster than the supply allows, an open bridge conducts through its diodes and brakes.
TEST(Drivetrain, OpenBridgeConductsOnceBackEmfExceedsTheSupply) {
  Board board(on_stand());
  board.set_load(Side::left, {.torque_Nm = 1.0});
  run_ms(board, 3000);
  const double speed = board.drivetrain().speed_radps()[0];
  const double no_current_radps = 12.0 / motor_from(MotorSheet{}, 43.8).emf_Vspr;
  EXPECT_GT(speed, no_current_radps);
  EXPECT_LT(speed, 1.3 * no_current_radps)
      << "without diodes viscous friction alone would allow 50 times that";
  EXPECT_LT(board.drivetrain().current_A()[0], 0.0) << "current flows back";
}

TEST(Drivetrain, DriverFaultOpensTheBridges) {
  Board board(ideal());
  board.motors().set_fault(true);
  board.motors().drive({32767, 32767});
  run_ms(board, 100);
  EXPECT_TRUE(at_rest(board));
  board.motors().set_fault(false);
  run_ms(board, 100);
  EXPECT_FALSE(at_rest(board));
}

TEST(Battery, SagsUnderLoadByItsResistance) {
  Config config;
  config.on_stand = true;
  Board board(config);
  EXPECT_EQ(board.battery().millivolts(), 12000);
  board.set_load(Side::left, {.drag_Nm = 100.0});
  board.set_load(Side::right, {.drag_Nm = 100.0});
  board.motors().drive({32767, 32767});
  run_ms(board, 100);
  // Both blocked: two windings in parallel behind the supply's resistance.
  const double winding_ohm = 12.0 / 7.0 / 2.0;
  EXPECT_NEAR(board.battery().millivolts(), 12000.0 * winding_ohm / (winding_ohm + 0.08), 1.0);
  board.motors().coast();
  run_ms(board, 100);
  EXPECT_EQ(board.battery().millivolts(), 12000);
}

// Ohm's law of source and winding, for a turning and loaded motor at part duty.
TEST(Battery, SupplyAndMotorsAgreeOnTheCurrent) {
  const Motor motor = motor_from(MotorSheet{}, 43.8);
  Config config;
  config.on_stand = true;
  config.supply_ohm = 0.5;
  Board board(config);
  board.set_load(Side::left, {.drag_Nm = 0.4});
  board.motors().drive({duty_for(9), duty_for(-6)});
  run_ms(board, 2000);
  const Drivetrain& wheels = board.drivetrain();
  const Pair current = wheels.current_A(), speed = wheels.speed_radps();
  const Pair duty = {duty_for(9) / 32767.0, duty_for(-6) / 32767.0};
  EXPECT_GT(speed[0], 1.0);
  EXPECT_LT(speed[1], -1.0);
  EXPECT_NEAR(wheels.bus_V(), 12.0 - 0.5 * (duty[0] * current[0] + duty[1] * current[1]), 1e-9);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(current[k] * motor.resistance_ohm, duty[k] * wheels.bus_V() - motor.emf_Vspr * speed[k],
                1e-9);
}

TEST(Battery, ReadingIsFilteredToAFewMilliseconds) {
  Board board(Config{});
  board.battery().set_open_circuit_V(9.0);
  board.advance_tick();
  EXPECT_GT(board.battery().millivolts(), 11000) << "one millisecond is a third of the time constant";
  run_ms(board, 50);
  EXPECT_NEAR(board.battery().millivolts(), 9000, 1);
}

}  // namespace
}  // namespace astro::sim
