#include "hal/sim/gyro.hpp"

#include <gtest/gtest.h>

#include "tests/hal/sim/support.hpp"

namespace astro::sim {
namespace {

Config with_gyro(const GyroConfig& gyro) {
  Config config = ideal();
  config.gyro = gyro;
  return config;
}

/// What the gyro says that the robot turned about its vertical axis in so many milliseconds, and how often it was sampled.
struct Said {
  double rad = 0;
  int samples = 0;
};
Said said(Board& board, int ms, std::size_t axis = 2) {
  Said sum;
  std::uint32_t last = board.gyro().read().number;
  for (int i = 0; i < ms; ++i) {
    board.advance_tick();
    const hal::GyroReading reading = board.gyro().read();
    if (reading.number == last) continue;
    last = reading.number;
    sum.rad += reading.rate[axis] * 1e-9 * reading.count_nradps * Gyro::kPeriod_ticks * 1e-3;
    ++sum.samples;
  }
  return sum;
}

TEST(SimulatedGyro, SamplesAddUpToWhatTheRobotTurned) {
  Board board(with_gyro({.angle_random_walk_rad = 0, .bias_radps = 0, .bias_walk_radps = 0}));
  run_ms(board, 100);
  board.motors().drive({duty_for(-3), duty_for(3)});
  const double turned = said(board, 1500).rad;
  board.motors().brake();
  const double all = turned + said(board, 500).rad;
  // A sample is rounded to 16 bits: 400 roundings of at most half a count for 5 ms.
  EXPECT_NEAR(all, board.truth().theta_rad, 400 * 0.5 * Gyro::kCount_radps * 0.005);
  EXPECT_GT(all, 1.0) << "it has turned";
}

TEST(SimulatedGyro, HasTheNoiseTheBiasAndTheScaleThatItIsGiven) {
  const GyroConfig gyro{.bias_radps = 0.01, .bias_walk_radps = 0, .scale = 1.01};
  double sum = 0, squares = 0;
  constexpr int kRobots = 400;
  for (int k = 0; k < kRobots; ++k) {
    Config config = with_gyro(gyro);
    config.seed = static_cast<std::uint64_t>(k);
    Board board(config);
    run_ms(board, 100);
    board.kick(0.02);
    const double error = said(board, 1000).rad - 1.01 * 0.02 - 0.01;
    sum += error;
    squares += error * error;
  }
  // Means and deviations of 400 robots are known to 5 and 3.5 %: three of them.
  const double mean = sum / kRobots, deviation = std::sqrt(squares / kRobots - mean * mean);
  EXPECT_NEAR(mean, 0, 3 * gyro.angle_random_walk_rad / std::sqrt(kRobots));
  EXPECT_NEAR(deviation, gyro.angle_random_walk_rad, 0.11 * gyro.angle_random_walk_rad);
}

TEST(SimulatedGyro, ABiasThatWalksSpreadsWithTheRootOfTime) {
  double squares[2] = {};
  constexpr int kRobots = 200;
  for (int k = 0; k < kRobots; ++k) {
    Config config = with_gyro({.bias_radps = 0, .bias_walk_radps = 1e-3});
    config.seed = static_cast<std::uint64_t>(k);
    Board board(config);
    for (double& sum : squares) {
      run_ms(board, 2000);
      sum += std::pow(board.gyro().bias_radps(), 2);
    }
  }
  // Known to 5 %: three of them. The sensor starts 65 ms late.
  EXPECT_NEAR(std::sqrt(squares[0] / kRobots), 1e-3 * std::sqrt(1.935), 0.15 * 1.4e-3);
  EXPECT_NEAR(std::sqrt(squares[1] / kRobots), 1e-3 * std::sqrt(3.935), 0.15 * 2e-3);
}

TEST(SimulatedGyro, FollowsTemperatureMountingAndLag) {
  Board board(with_gyro({.angle_random_walk_rad = 0,
                         .bias_radps = 0,
                         .bias_walk_radps = 0,
                         .bias_per_K_radps = 0.001,
                         .lag_s = 0.020,
                         .axis = -1}));
  run_ms(board, 100);
  board.kick(0.01);
  EXPECT_EQ(said(board, 15).rad, 0) << "not yet";
  EXPECT_NEAR(said(board, 20, 0).rad, -0.01, 0.5 * Gyro::kCount_radps * 0.005)
      << "about x, which points down";
  board.gyro().set_temperature(35);
  EXPECT_NEAR(said(board, 1000, 0).rad, -0.01, 200 * 0.5 * Gyro::kCount_radps * 0.005);
  EXPECT_EQ(board.gyro().read().temperature_cC, 3500);
}

TEST(SimulatedGyro, DoesNotChangeWhatTheRobotDoesByABit) {
  Config with = with_gyro({}), without = with;
  with.slip_m = without.slip_m = 2.645e-6;
  without.gyro.reset();
  Board one(with), other(without);
  for (Board* board : {&one, &other}) {
    board->motors().drive({duty_for(4), duty_for(6)});
    run_ms(*board, 3000);
  }
  EXPECT_EQ(one.truth().theta_rad, other.truth().theta_rad);
  EXPECT_EQ(one.truth().x_m, other.truth().x_m);
  EXPECT_EQ(one.encoders().read().left, other.encoders().read().left);
}

TEST(SimulatedGyro, FailsAsSensorsDo) {
  Board board(with_gyro({}));
  run_ms(board, 100);
  board.gyro().set_fault(GyroFault::silent);
  EXPECT_EQ(said(board, 100).samples, 0);
  board.gyro().set_fault(GyroFault::frozen);
  const auto rate = board.gyro().read().rate;
  EXPECT_EQ(said(board, 100).samples, 20);
  EXPECT_EQ(board.gyro().read().rate, rate);
}

TEST(SimulatedGyro, DoesNotNoticeThatTheRobotIsPutSomewhereElse) {
  Board board(with_gyro({.angle_random_walk_rad = 0, .bias_radps = 0, .bias_walk_radps = 0}));
  run_ms(board, 100);
  board.place({1, 2, 3});
  EXPECT_EQ(said(board, 100).rad, 0);
}

}  // namespace
}  // namespace astro::sim
