#include "firmware/app/tick/gyro_heading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "firmware/app/tick/control_tick.hpp"
#include "hal/sim/board.hpp"

// The control tick on a simulated robot with a gyro, without a host.
namespace astro {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;

struct GyroRobot {
  explicit GyroRobot(const sim::Config& config, const ParameterSet& set) : board(config), tick(board) {
    state().configure(TickState<true>::Configuration(set));
  }

  TickState<true>& state() { return tick.state().get(hold); }
  Drive& drive() { return state().drive; }
  protocol::FusedGroup fused() { return state().gyro.report(drive(), board.clock().now_us()); }
  double fused_rad() {
    return (fused().turns + static_cast<double>(fused().theta) * 0x1p-64) * 2 * std::numbers::pi;
  }
  double odometry_rad() {
    const Pose& pose = drive().pose();
    return (pose.turns + static_cast<double>(pose.theta.raw()) * 0x1p-64) * 2 * std::numbers::pi;
  }

  void run_ms(int ms) {
    for (int i = 0; i < ms; ++i) {
      drive().host_seen();
      drive().plan();
      tick.run();
      if (UnseenTurn slip; state().gyro.take_slip(slip)) {
        ++slips;
        last_slip = slip;
      }
      board.advance_tick();
    }
  }
  /// To the end of all segments.
  void run_to_rest() {
    for (int ms = 0; ms < 300'000 && (drive().gives_power() || drive().queued() != 0); ms += 10) run_ms(10);
  }
  void line(double length_m) {
    drive().add_segment(
        {.length_nm = std::llround(length_m * 1e9), .speed_umps = 300'000, .yaw_rate_uradps = 1'000'000}, 1);
  }
  void spin(double turn) {
    drive().add_segment(
        {.angle_32 = std::llround(turn * 0x1p32), .speed_umps = 300'000, .yaw_rate_uradps = 1'000'000}, 1);
  }
  /// A square of so many metres, four spins to the left.
  void square(double side_m) {
    for (int side = 0; side < 4; ++side) {
      line(side_m);
      spin(0.25);
    }
    run_to_rest();
  }
  void arm() {
    run_ms(100);
    ASSERT_TRUE(drive().arm());
  }

  sim::Board board;
  sim::Board::Hold hold = board.hold_tick();
  ControlTick<sim::Board> tick;
  int slips = 0;
  UnseenTurn last_slip;
};

ParameterSet with_gyro() {
  ParameterSet set = ParameterSet::defaults();
  set.set(Param::gyro_axis, 3);
  return set;
}

sim::Config robot_with_gyro(std::uint64_t seed = 1) {
  sim::Config config;
  config.gyro.emplace();
  config.seed = seed;
  return config;
}

TEST(GyroHeading, IsBetterThanTheWheelsWhereTheySlip) {
  double wheels = 0, fused = 0, apart = 0;
  constexpr int kRobots = 12;
  for (int k = 0; k < kRobots; ++k) {
    sim::Config config = robot_with_gyro(static_cast<std::uint64_t>(k));
    config.slip_m = 4 * 2.645e-6;
    GyroRobot robot(config, with_gyro());
    robot.run_ms(3000);
    robot.arm();
    for (int i = 0; i < 2; ++i) robot.square(1);
    robot.run_ms(300);
    const double truth_rad = robot.board.truth().theta_rad;
    wheels += std::pow((robot.odometry_rad() - truth_rad) / kDegree_rad, 2);
    fused += std::pow((robot.fused_rad() - truth_rad) / kDegree_rad, 2);
    const double x_m = static_cast<double>(robot.fused().x) * 0x1p-40,
                 y_m = static_cast<double>(robot.fused().y) * 0x1p-40;
    apart += std::pow(x_m - robot.board.truth().x_m, 2) + std::pow(y_m - robot.board.truth().y_m, 2);
    EXPECT_EQ(robot.fused().gyro, protocol::GyroState::running);
  }
  wheels = std::sqrt(wheels / kRobots);
  fused = std::sqrt(fused / kRobots);
  std::printf("  two squares, seeds 0 to %d: wheels %.2f, with the gyro %.2f degrees rms, %.0f mm\n",
              kRobots - 1, wheels, fused, 1000 * std::sqrt(apart / kRobots));
  EXPECT_LT(fused, wheels / 2);
}

TEST(GyroHeading, LeavesTheOdometryAndTheDriveAsTheyAreBitForBit) {
  GyroRobot with(robot_with_gyro(), with_gyro()), without(sim::Config{}, ParameterSet::defaults());
  for (GyroRobot* robot : {&with, &without}) {
    robot->arm();
    robot->square(0.5);
  }
  EXPECT_EQ(with.drive().pose().x, without.drive().pose().x);
  EXPECT_EQ(with.drive().pose().y, without.drive().pose().y);
  EXPECT_EQ(with.drive().pose().theta, without.drive().pose().theta);
  EXPECT_EQ(with.board.clock().now_us(), without.board.clock().now_us());
  EXPECT_EQ(with.board.truth().theta_rad, without.board.truth().theta_rad);
}

TEST(GyroHeading, FollowsAKickAndTellsIt) {
  for (const double kick_deg : {-20.0, 20.0}) {
    GyroRobot robot(robot_with_gyro(), with_gyro());
    robot.run_ms(2000);
    robot.arm();
    robot.line(2);
    robot.run_ms(3000);
    const double before_rad = robot.fused_rad() - robot.board.truth().theta_rad;
    const std::uint64_t began_us = robot.board.clock().now_us();
    for (int i = 0; i < 200; ++i) {
      robot.board.kick(kick_deg * kDegree_rad / 200);
      robot.run_ms(1);
    }
    robot.run_ms(300);
    EXPECT_NEAR(robot.fused_rad() - robot.board.truth().theta_rad, before_rad, 0.1 * kDegree_rad);
    EXPECT_EQ(robot.slips, 1);
    EXPECT_LE(robot.last_slip.time_us - began_us, 150'000U);
    EXPECT_GT(robot.last_slip.turn_100urad * kick_deg, 0);
    EXPECT_TRUE(robot.drive().gives_power()) << "nobody wanted it to stop";
    EXPECT_EQ(robot.fused().slips, 1);
  }
}

TEST(GyroHeading, ASlipStopsTheRobotIfThePersonWantsItAndOnlyWhileItIsDriven) {
  ParameterSet set = with_gyro();
  set.set(Param::gyro_slip_stops, 1);
  GyroRobot robot(robot_with_gyro(), set);
  robot.run_ms(2000);
  const auto kick = [&] {
    for (int i = 0; i < 200; ++i) {
      robot.board.kick(10 * kDegree_rad / 200);
      robot.run_ms(1);
    }
    robot.run_ms(800);
  };
  kick();
  EXPECT_EQ(robot.slips, 1);
  EXPECT_FALSE(robot.drive().faults().any()) << "somebody turned it by hand";
  robot.arm();
  robot.line(2);
  robot.run_ms(2000);
  kick();
  EXPECT_EQ(robot.drive().faults().mask(), bit(Fault::gyro_slip));
  EXPECT_FALSE(robot.drive().gives_power());
  EXPECT_EQ(robot.board.motors().state(), sim::Bridge::coast);
}

TEST(GyroHeading, WithoutAGoodReadingItGoesOnAsTheWheelsDoAndSaysWhy) {
  using protocol::GyroState;
  const auto expect_wheels = [](sim::GyroFault fault, GyroState says) {
    GyroRobot robot(robot_with_gyro(), with_gyro());
    robot.run_ms(2000);
    robot.arm();
    robot.line(1);
    robot.run_ms(1000);
    ASSERT_EQ(robot.fused().gyro, GyroState::running);
    robot.board.gyro().set_fault(fault);
    robot.run_ms(150);
    EXPECT_EQ(robot.fused().gyro, says);
    const double apart_rad = robot.fused_rad() - robot.odometry_rad();
    robot.spin(0.25);
    robot.run_ms(200);
    // The pose is up to 10 ms old: at 1 rad/s, 10 mrad; with the wheels at rest, none.
    robot.run_to_rest();
    robot.run_ms(100);
    EXPECT_NEAR(robot.fused_rad() - robot.odometry_rad(), apart_rad, 1e-3);
    robot.board.gyro().set_fault(sim::GyroFault::none);
    robot.run_ms(500);
    EXPECT_EQ(robot.fused().gyro, GyroState::running);
    EXPECT_NEAR(robot.fused_rad() - robot.odometry_rad(), apart_rad, 0.5 * kDegree_rad) << "without a jump";
    EXPECT_EQ(robot.slips, 0);
  };
  expect_wheels(sim::GyroFault::unplugged, GyroState::failed);
  expect_wheels(sim::GyroFault::silent, GyroState::silent);
  expect_wheels(sim::GyroFault::frozen, GyroState::frozen);
}

TEST(GyroHeading, SaysWhileTheRobotTurnsFasterThanTheGyroMeasures) {
  GyroRobot robot(robot_with_gyro(), with_gyro());
  robot.run_ms(2000);
  for (int i = 0; i < 40; ++i) {
    robot.board.kick(0.01);
    robot.run_ms(1);
  }
  EXPECT_EQ(robot.fused().gyro, protocol::GyroState::saturated);
  EXPECT_NEAR(robot.fused().rate_uradps, 8.9e6, 0.1e6) << "all that 16 bits can say";
  robot.run_ms(100);
  EXPECT_EQ(robot.fused().gyro, protocol::GyroState::running);
}

TEST(GyroHeading, AKickFasterThanTheGyroMeasuresIsASlip) {
  ParameterSet set = with_gyro();
  set.set(Param::gyro_slip_stops, 1);
  GyroRobot robot(robot_with_gyro(), set);
  robot.run_ms(2000);
  robot.arm();
  robot.line(2);
  robot.run_ms(2000);
  for (int i = 0; i < 40; ++i) {
    robot.board.kick(0.012);
    robot.run_ms(1);
  }
  robot.run_ms(800);
  EXPECT_EQ(robot.slips, 1);
  EXPECT_EQ(robot.drive().faults().mask(), bit(Fault::gyro_slip));
}

TEST(GyroHeading, ASlipThatBeganWithoutPowerStopsARobotThatIsGivenPower) {
  ParameterSet set = with_gyro();
  set.set(Param::gyro_slip_stops, 1);
  GyroRobot robot(robot_with_gyro(), set);
  robot.run_ms(2000);
  for (int i = 0; i < 400; ++i) {
    robot.board.kick(20 * kDegree_rad / 400);
    robot.run_ms(1);
    if (i == 200) {
      ASSERT_EQ(robot.slips, 1);
      ASSERT_TRUE(robot.drive().arm());
      robot.line(1);
    }
  }
  EXPECT_EQ(robot.slips, 1);
  EXPECT_EQ(robot.drive().faults().mask(), bit(Fault::gyro_slip));
}

TEST(GyroHeading, FindsTheMountingTheScaleAndTheLagInTheParameters) {
  for (const int axis : {-3, -2, -1, 1, 2, 3}) {
    sim::Config config = robot_with_gyro();
    config.slip_m = 0;
    config.gyro->axis = axis;
    config.gyro->scale = 1.04;
    config.gyro->lag_s = 0.060;
    ParameterSet set = with_gyro();
    set.set(Param::gyro_axis, axis);
    set.set(Param::gyro_scale, static_cast<std::int32_t>(1.04 * 0x1p30));
    set.set(Param::gyro_lag, 65);
    GyroRobot robot(config, set);
    robot.run_ms(6000);
    robot.arm();
    for (int i = 0; i < 4; ++i) robot.spin(i % 2 == 0 ? 1 : -0.5);
    robot.run_to_rest();
    robot.run_ms(300);
    EXPECT_EQ(robot.slips, 0) << axis;
    // Half a minute of a bias that six seconds have shown is 0.3 degrees, three of which are allowed. The scale alone would be 14.
    EXPECT_NEAR(robot.fused_rad(), robot.board.truth().theta_rad, 1.0 * kDegree_rad) << axis;
  }
}

TEST(GyroHeading, APoseThatIsSetIsThePoseOfBoth) {
  GyroRobot robot(robot_with_gyro(), with_gyro());
  robot.run_ms(2000);
  robot.board.kick(0.3);
  robot.run_ms(1000);
  robot.state().set_pose(
      {std::int64_t{3} << 40, std::int64_t{-4} << 40, Angle::from_raw(std::uint64_t{1} << 62), 0});
  EXPECT_EQ(robot.fused().time_us, robot.board.clock().now_us()) << "a pose of now";
  EXPECT_EQ(robot.fused().rate_uradps, 0) << "no step has ended since";
  robot.run_ms(1000);
  EXPECT_LT(robot.fused().time_us, robot.board.clock().now_us());
  EXPECT_NEAR(static_cast<double>(robot.fused().x) * 0x1p-40, 3, 1e-6);
  EXPECT_NEAR(static_cast<double>(robot.fused().y) * 0x1p-40, -4, 1e-6);
  EXPECT_NEAR(robot.fused_rad(), std::numbers::pi / 2, 0.2 * kDegree_rad);
}

TEST(GyroHeading, AFaultInAStepThatIsLeftOutIsNotOneOfTheNextStep) {
  GyroRobot robot(robot_with_gyro(), with_gyro());
  robot.run_ms(2000);
  robot.board.gyro().set_fault(sim::GyroFault::silent);
  robot.run_ms(100);
  ASSERT_EQ(robot.fused().gyro, protocol::GyroState::silent);
  const auto to_end_of_step = [&robot] {
    do robot.run_ms(1);
    while (robot.drive().phase() != 2);  // in which the filter takes the step
  };
  to_end_of_step();
  robot.board.gyro().set_fault(sim::GyroFault::none);
  robot.state().set_pose({});
  to_end_of_step();  // begun within the ten ticks: left out
  to_end_of_step();
  EXPECT_EQ(robot.fused().gyro, protocol::GyroState::running);
}

TEST(GyroHeading, IsTheOdometryIfNoGyroIsUsed) {
  GyroRobot robot(robot_with_gyro(), ParameterSet::defaults());
  robot.run_ms(2000);
  robot.arm();
  robot.spin(0.25);
  robot.run_to_rest();
  EXPECT_EQ(robot.fused().gyro, protocol::GyroState::off);
  EXPECT_EQ(robot.fused().theta, robot.drive().pose().theta.raw());
}

}  // namespace
}  // namespace astro
