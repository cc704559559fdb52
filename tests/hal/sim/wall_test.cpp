#include "hal/sim/wall.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "hal/sim/board.hpp"
#include "hal/sim/motor.hpp"
#include "tests/hal/sim/support.hpp"

namespace astro::sim {
namespace {

constexpr double kRadius_m = 0.036;

/// A wall ahead of a robot that starts in the origin; its front is 162.5 mm ahead of the axle.
Config facing_wall(double gap_m) {
  Config config = ideal();
  config.wall = WallConfig{.x_m = 0.1625 + gap_m};
  return config;
}

/// What the motors of both wheels push with at most when they stand under this voltage.
double stall_push_N(double volts) {
  const Motor motor = motor_from(MotorSheet{}, Config{}.gear_ratio);
  return 2 * (1 - motor.mesh_loss) * motor.emf_Vspr * volts / motor.resistance_ohm / kRadius_m;
}

/// The most that the robot pressed while it was driven with these voltages.
double press_for_ms(Board& board, int ms, double left_V, double right_V) {
  double most_N = 0;
  for (int i = 0; i < ms; ++i) {
    board.motors().drive({duty_for(left_V), duty_for(right_V)});
    board.advance_tick();
    most_N = std::max(most_N, board.pressing_N());
  }
  return most_N;
}

/// By how much the heading of a robot at rest may differ from that of the wall: the friction of a motor, 1 V worth of torque and what
/// its gear takes of the motor's, holds each wheel the one way or the other, and the wall holds the corners; they give way differently
/// under that.
double play_rad(const Board& board, const Config& config, double volts) {
  const double per_width = 1 / config.body.width_m;
  const double loss = motor_from(MotorSheet{}, config.gear_ratio).mesh_loss;
  const double friction_N = stall_push_N(1.0) + loss / (1 - loss) * stall_push_N(volts);
  const double by_wheels_N = friction_N * config.true_wheelbase_m * per_width;
  const double by_corners_N =
      2 * config.wall->friction * board.pressing_N() * config.body.ahead_m * per_width;
  return (by_wheels_N + by_corners_N) / config.wall->stiffness_Npm * per_width;
}

double error_rad(const Board& board) { return board.truth().theta_rad; }

TEST(Wall, ObliqueRobotTurnsUntilItsFrontIsFlush) {
  for (const double oblique_rad : {-0.3, -0.1, -0.02, 0.005, 0.05, 0.2}) {
    for (const double friction : {0.0, 0.3, 0.6}) {
      Config config = facing_wall(0.08);
      config.wall->friction = friction;
      Board board(config);
      board.place({0, 0, oblique_rad});
      press_for_ms(board, 15'000, 1.4, 1.4);
      EXPECT_TRUE(at_rest(board)) << oblique_rad << ", friction " << friction;
      EXPECT_NEAR(error_rad(board), 0, play_rad(board, config, 1.4))
          << oblique_rad << ", friction " << friction;
    }
  }
}

TEST(Wall, StandsInAnyDirection) {
  for (const double turned_rad : {0.0, 1.0, 2.5, -2.0}) {
    Config config = facing_wall(0.05);
    const double c = std::cos(turned_rad), s = std::sin(turned_rad), ahead_m = config.wall->x_m;
    config.wall =
        WallConfig{.x_m = ahead_m * c, .y_m = ahead_m * s, .out_rad = turned_rad + std::numbers::pi};
    Board board(config);
    board.place({0, 0, turned_rad + 0.1});
    press_for_ms(board, 5000, 1.4, 1.4);
    const double error =
        std::remainder(board.truth().theta_rad - board.wall()->flush_heading_rad(), 2 * std::numbers::pi);
    EXPECT_NEAR(error, 0, play_rad(board, config, 1.4)) << turned_rad;
    EXPECT_NEAR(board.wall()->front_gap_m(board.truth()), 0, 1e-3);
    EXPECT_NEAR(board.wall()->rear_gap_m(board.truth()), 0.325, 1e-3) << "the ruler";
  }
}

TEST(Wall, PushIsBoundedByTheTorqueOfTheMotorsAtTheirDuty) {
  Config config = facing_wall(0.0);
  config.grip_N = 1e3;
  Board board(config);
  for (double volts = 0; volts < 6; volts += 0.001) {
    press_for_ms(board, 1, volts, volts);
    ASSERT_LE(board.pressing_N(), stall_push_N(volts) + 1e-9) << volts << " V";
  }
  EXPECT_TRUE(at_rest(board));
  // Friction takes at most the starting voltage's worth of it.
  EXPECT_GE(board.pressing_N(), stall_push_N(6 - 1.0) * 0.99);
  EXPECT_NEAR(board.drivetrain().current_A()[0], 6 / (12.0 / 7.0), 2e-3) << "a stalled motor";
}

TEST(Wall, BlowOfTheBodyAddsItsMomentumAndNoMore) {
  for (const double slip_m : {0.0, 2.645e-6}) {
    for (const double volts : {1.1, 2.0, 4.0}) {
      Config config = facing_wall(0.3);
      config.slip_m = slip_m;
      config.grip_N = 1e3;
      Board board(config);
      const double before_m = board.truth().x_m;
      double speed_mps = 0;
      while (board.pressing_N() == 0) {
        speed_mps = board.drivetrain().speed_radps()[0] * kRadius_m;
        press_for_ms(board, 1, volts, volts);
      }
      ASSERT_GT(board.truth().x_m, before_m);
      // Energy: k x^2 / 2 <= m v^2 / 2 + F x gives k x <= F + sqrt(F^2 + k m v^2); body and rotors are 9.2 kg, both corners one spring,
      // and slip can carry the robot a fifth further than its wheels.
      const double push_N = stall_push_N(volts), k_Npm = 2 * config.wall->stiffness_Npm;
      const double blow_N = push_N + std::sqrt(push_N * push_N + k_Npm * 9.2 * speed_mps * speed_mps);
      EXPECT_LE(press_for_ms(board, 500, volts, volts), blow_N * (slip_m > 0 ? 1.2 : 1.0)) << volts;
    }
  }
}

TEST(Wall, TyresSkidUnderMoreTorqueThanTheyGrip) {
  Board board(facing_wall(0.0));
  press_for_ms(board, 2000, 6, 6);
  const double x_m = board.truth().x_m;
  const std::int32_t count = board.encoders().read().left;
  const double most_N = press_for_ms(board, 1000, 6, 6);
  EXPECT_GT(board.encoders().read().left, count + 1000) << "the wheels turn";
  EXPECT_NEAR(board.truth().x_m, x_m, 1e-3) << "the robot does not move";
  EXPECT_LE(most_N, 2 * Config{}.grip_N * 1.05);
}

TEST(Wall, ContactGivesNoEnergy) {
  for (const double oblique_rad : {0.0, 0.2}) {
    for (const double volts : {1.5, 3.0, 8.0}) {
      Config config = facing_wall(0.4);
      config.grip_N = 1e6;
      Board board(config);
      board.place({0, 0, oblique_rad});
      while (board.pressing_N() == 0) press_for_ms(board, 1, volts, volts);
      board.motors().coast();
      double most_J = board.drivetrain().kinetic_energy_J();
      const double before_J = most_J;
      for (int ms = 0; ms < 2000; ++ms) {
        board.advance_tick();
        most_J = std::max(most_J, board.drivetrain().kinetic_energy_J());
        if (board.pressing_N() == 0 && ms > 20) break;
      }
      EXPECT_LE(most_J, before_J * (1 + 1e-9)) << volts << " V";
      EXPECT_LT(board.drivetrain().kinetic_energy_J(), before_J) << volts << " V";
    }
  }
}

TEST(Wall, MovingAwayFreesTheRobot) {
  Board board(facing_wall(0.02));
  press_for_ms(board, 2000, 1.4, 1.4);
  ASSERT_GT(board.pressing_N(), 0.0);
  press_for_ms(board, 1000, -2, -2);
  EXPECT_EQ(board.pressing_N(), 0.0);
  Board free(ideal());
  const double x_m = board.truth().x_m;
  press_for_ms(board, 1000, -2, -2);
  press_for_ms(free, 1000, -2, -2);
  const double from_rest_m = free.truth().x_m;
  press_for_ms(free, 1000, -2, -2);
  EXPECT_NEAR(board.truth().x_m - x_m, free.truth().x_m - from_rest_m, 0.01);
}

TEST(Wall, AllCornersPushTheRobotOutOfTheWallThatTurnsBesideIt) {
  Config config = ideal();
  config.wall = WallConfig{.x_m = 0.2};
  Board board(config);
  double deepest_m = 0;
  for (int ms = 0; ms < 4000; ++ms) {
    press_for_ms(board, 1, -1.4, 1.4);
    const Pose pose = board.truth();
    for (const double ahead_m : {0.1625, -0.1625})
      for (const double left_m : {0.1685, -0.1685})
        deepest_m = std::max(deepest_m, pose.x_m + ahead_m * std::cos(pose.theta_rad) -
                                            left_m * std::sin(pose.theta_rad) - 0.2);
  }
  EXPECT_GT(board.truth().theta_rad, 1.5) << "its side to the wall, where it cannot move aside";
  EXPECT_LT(board.truth().x_m, -0.03) << "a turn needs 234 mm";
  EXPECT_LT(deepest_m, stall_push_N(1.4) / 1e4 * 1.5) << "a corner under all of the push, and a blow";
}

TEST(Wall, UnevenSurfaceTurnsTheFlushRobotByItsCornersHeights) {
  double sum = 0;
  constexpr int kWalls = 200;
  for (int i = 0; i < kWalls; ++i) {
    Config config = facing_wall(0.0);
    config.seed = static_cast<std::uint64_t>(i) + 1;
    config.wall->unevenness_m = 5e-4;
    Board board(config);
    press_for_ms(board, 3000, 1.4, 1.4);
    sum += error_rad(board) * error_rad(board);
  }
  // Both corners: 0.5 mm sqrt(2) / 337 mm = 2.1 mrad at points of the drawing, sqrt(2/3) of it on average between them; of 200
  // such squares the root mean is known to 5 %.
  EXPECT_NEAR(std::sqrt(sum / kWalls), 1.8e-3, 0.6e-3);
}

std::vector<std::uint64_t> trace(const Config& config) {
  Board board(config);
  std::vector<std::uint64_t> bits;
  for (int part = 0; part < 3; ++part) {
    eventful_drive(board);
    for (const double value :
         {board.truth().x_m, board.truth().y_m, board.truth().theta_rad, board.drivetrain().bus_V()})
      bits.push_back(std::bit_cast<std::uint64_t>(value));
    bits.push_back(static_cast<std::uint32_t>(board.encoders().read().left));
    bits.push_back(static_cast<std::uint32_t>(board.encoders().read().right));
  }
  return bits;
}

TEST(Wall, OutOfReachChangesNoBit) {
  Config config;
  config.wall = WallConfig{.x_m = 50};
  EXPECT_EQ(trace(Config{}), trace(config));
}

TEST(Wall, AFrontWithPlaySettlesAnewOnceItHasLeftTheWall) {
  constexpr double kPlay_rad = 0.01;
  const Body body{.front_play_rad = kPlay_rad};
  const WallConfig config;
  Wall wall(config, body, 7);
  const auto stand_m = [&](double gap_m) { wall.force({config.x_m - body.ahead_m - gap_m, 0, 0}, 0, 0); };
  constexpr int kTouches = 400;
  double squares = 0;
  for (int i = 0; i < kTouches; ++i) {
    stand_m(-0.003);
    const double settled_rad = wall.flush_heading_rad();
    stand_m(0.01);
    stand_m(-0.003);
    EXPECT_EQ(wall.flush_heading_rad(), settled_rad) << "it has hardly left the wall";
    squares += std::pow(std::remainder(settled_rad, 2 * std::numbers::pi), 2) / kTouches;
    stand_m(0.05);
    EXPECT_NE(wall.flush_heading_rad(), settled_rad);
  }
  EXPECT_NEAR(std::sqrt(squares), kPlay_rad, 0.1 * kPlay_rad) << "a deviation of 400 scatters by 3.5 %";
}

}  // namespace
}  // namespace astro::sim
