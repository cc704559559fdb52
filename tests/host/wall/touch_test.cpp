#include "host/wall/touch.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "host/base/interrupted.hpp"
#include "host/robot/parameters/parameters.hpp"
#include "host/wall/wall_drive.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/wall_desk.hpp"

namespace astro::wall {
namespace {

using support::Desk;
using support::kThesisSlip_m;
using support::ThrowsTelling;

sim::Config facing(double gap_m) {
  sim::Config config;
  config.slip_m = kThesisSlip_m;
  config.wall = sim::WallConfig{.x_m = config.body.ahead_m + gap_m};
  return config;
}

/// What a host does to a robot in front of a wall.
class Touching : public testing::Test {
 protected:
  void begin(const sim::Config& config, double oblique_rad = 0) {
    desk = std::make_unique<Desk>(config);
    board().place({0, 0, oblique_rad});
    robot = wall_robot_of(robot::RemoteParameters::fetch(desk->client));
    push_V = push_voltage_V({}, robot);
  }
  sim::Board& board() { return desk->robot->board(); }
  double off_rad() {
    return std::remainder(board().truth().theta_rad - board().wall()->flush_heading_rad(),
                          2 * std::numbers::pi);
  }
  protocol::Mode mode() { return desk->client.request(protocol::GetStatus{}).mode; }
  Touch touch(double within_m = 0.3) {
    WheelWatch watch(desk->client, robot.count_m);
    robot::DriveSession session(desk->client);
    const Touch touch = square_against_wall(session, watch, desk->client, robot, push_V, within_m);
    session.end();
    return touch;
  }
  void expect_gentle() {
    EXPECT_LE(board().wall_record().hardest_N, PushLimit{}.force_N);
    EXPECT_LE(board().wall_record().longest_stall_ticks, 1000 * (kStall_s + 0.1))
        << "a tenth of a second to notice";
  }

  std::unique_ptr<Desk> desk;
  WallRobot robot;
  double push_V = 0;
};

TEST_F(Touching, TurnsARobotFlushFromAnyObliqueStartGently) {
  for (const double oblique_rad : {-0.35, -0.1, -0.01, 0.0, 0.02, 0.17, 0.35}) {
    for (const double friction : {0.0, 0.3, 0.6}) {
      sim::Config config = facing(0.1);
      config.wall->friction = friction;
      begin(config, oblique_rad);
      touch();
      // What friction holds (tests/hal/sim): motors a wheel, the wall the corners.
      EXPECT_NEAR(off_rad(), 0, 0.005) << oblique_rad << ", friction " << friction;
      EXPECT_EQ(mode(), protocol::Mode::disarmed);
      SCOPED_TRACE(fmt::format("{} rad, friction {}", oblique_rad, friction));
      expect_gentle();
    }
  }
}

TEST_F(Touching, StopsAtOnceIfAWheelTurnsTheWrongWay) {
  const std::vector<std::pair<bool sim::Wiring::*, std::string>> wrong{
      {&sim::Wiring::left_motor_reversed, "left"},
      {&sim::Wiring::right_motor_reversed, "right"},
      {&sim::Wiring::left_encoder_reversed, "left"},
      {&sim::Wiring::right_encoder_reversed, "right"}};
  for (const auto& [wire, side] : wrong) {
    sim::Config config = facing(0.2);
    config.wiring.*wire = true;
    begin(config);
    const std::uint64_t began_us = board().world_us();
    EXPECT_THAT([&] { touch(); }, ThrowsTelling<NotFlush>(WallProblem::runs_backwards, side));
    EXPECT_LT(board().world_us() - began_us, 1'500'000U) << "the pause with shorted motors included";
    EXPECT_LT(std::abs(board().truth().theta_rad), 0.15) << side;
    EXPECT_EQ(mode(), protocol::Mode::disarmed);
  }
}

TEST_F(Touching, StopsAtOnceIfBothMotorsAreReversed) {
  for (const double gap_m : {0.02, 0.05, 0.1, 0.15, 0.2}) {
    for (const double friction_V : {0.0, 0.5}) {  // beyond what the robot knows of
      sim::Config config = facing(gap_m);
      config.wiring.left_motor_reversed = config.wiring.right_motor_reversed = true;
      config.seed = static_cast<std::uint64_t>(1000 * gap_m);
      begin(config);
      for (double& kS_V : robot.kS_V) kS_V = std::max(0.0, kS_V - friction_V);
      EXPECT_THROW(touch(), NotFlush);
      EXPECT_GT(board().truth().x_m, -0.08) << gap_m;
      EXPECT_EQ(mode(), protocol::Mode::disarmed);
    }
  }
}

TEST_F(Touching, EndsGentlyIfMotorsOrEncodersAreExchanged) {
  for (bool sim::Wiring::*wire : {&sim::Wiring::motors_swapped, &sim::Wiring::encoders_swapped})
    for (const double oblique_rad : {0.0, 0.2}) {
      sim::Config config = facing(0.1);
      config.wiring.*wire = true;
      begin(config, oblique_rad);
      try {
        touch();
      } catch (const NotFlush&) {  // or flush, which a straight approach may bring about
      }
      EXPECT_LE(board().wall_record().hardest_N, PushLimit{}.force_N);
      EXPECT_LT(std::abs(board().truth().theta_rad), 0.8);
      EXPECT_EQ(mode(), protocol::Mode::disarmed);
    }
}

TEST_F(Touching, TurnsARobotWhoseWheelsStandOutsideItsFront) {
  // The corner that touches is nearer to the middle than its wheel, which the wall therefore rolls back.
  for (const double oblique_rad : {-0.3, 0.3}) {
    sim::Config config = facing(0.1);
    config.body.width_m = 0.2;
    config.wall = sim::WallConfig{.x_m = config.body.ahead_m + 0.1};
    begin(config, oblique_rad);
    touch();
    EXPECT_NEAR(off_rad(), 0, 0.005) << oblique_rad;
  }
}

TEST_F(Touching, DoesNotTurnARobotThatDoesNotFaceTheWall) {
  begin(facing(0.1), 1.0);
  EXPECT_THAT([&] { touch(); }, ThrowsTelling<NotFlush>(WallProblem::turned_away));
  EXPECT_LT(std::abs(board().truth().theta_rad - 1.0), 0.9);
}

TEST_F(Touching, KnowsTheWallByTheWayThatItCrept) {
  begin(facing(0.06));
  EXPECT_NEAR(touch().crept_m, 0.06, 0.002);
}

TEST_F(Touching, HardlyMovesARobotThatIsFlush) {
  begin(facing(0.03));
  touch();
  const sim::Pose before = board().truth();
  robot::DriveSession(desk->client).run(robot::line(-0.05));
  touch(0.1);
  EXPECT_NEAR(board().truth().x_m, before.x_m, 0.001);
  EXPECT_NEAR(board().truth().theta_rad, before.theta_rad, 0.003);
}

TEST_F(Touching, FindsNoWallWhereThereIsNone) {
  begin(facing(1.0));
  EXPECT_THAT([&] { touch(0.1); }, ThrowsTelling<NotFlush>(WallProblem::no_wall, "100 mm"));
  EXPECT_LT(board().truth().x_m, 0.15);
  EXPECT_EQ(mode(), protocol::Mode::disarmed);
}

TEST_F(Touching, NoticesWheelsThatDoNotTurnOnSoLittleVoltage) {
  begin(facing(0.1));
  for (const Side side : {Side::left, Side::right}) board().set_load(side, {0, 100});
  EXPECT_THAT([&] { touch(); }, ThrowsTelling<NotFlush>(WallProblem::wheels_stand, "left", "right"));
  expect_gentle();
}

TEST_F(Touching, StopsWhenItIsInterrupted) {
  begin(facing(0.1));
  for (const int at_ms : {200, 3000, 7000}) {
    begin(facing(0.1));
    WheelWatch watch(desk->client, robot.count_m);
    const std::uint64_t end_us = board().world_us() + static_cast<std::uint64_t>(at_ms) * 1000;
    robot::DriveHooks hooks;
    hooks.interrupted = [&] { return board().world_us() >= end_us; };
    {
      robot::DriveSession session(desk->client, hooks);
      EXPECT_THROW(square_against_wall(session, watch, desk->client, robot, push_V, 0.3), Interrupted)
          << at_ms;
    }
    EXPECT_EQ(mode(), protocol::Mode::disarmed);
    expect_gentle();
  }
}

TEST_F(Touching, AHostThatDiesLeavesNoMotorStalledForASecond) {
  for (int at_ms = 7000; at_ms < 9000; at_ms += 97) {
    begin(facing(0.1));
    const std::uint64_t end_us = board().world_us() + static_cast<std::uint64_t>(at_ms) * 1000;
    struct Dies {};
    robot::DriveHooks hooks;
    hooks.interrupted = [&] {
      if (board().world_us() < end_us) return false;
      for (int ms = 0; ms < 3000; ++ms) desk->robot->step();  // nobody says anything
      throw Dies{};
    };
    WheelWatch watch(desk->client, robot.count_m);
    try {
      robot::DriveSession session(desk->client, hooks);
      square_against_wall(session, watch, desk->client, robot, push_V, 0.3);
    } catch (const Dies&) {
    }
    EXPECT_EQ(board().motors().state(), sim::Bridge::coast) << at_ms;
    EXPECT_LE(board().wall_record().longest_stall_ticks, 1000) << at_ms;
    EXPECT_LE(board().wall_record().hardest_N, PushLimit{}.force_N) << at_ms;
  }
}

// The link lives, but nobody sees any more what the wheels do: the robot's own time-out takes the voltage away, or the host does
// where somebody has made the robot patient.
TEST_F(Touching, TakesTheVoltageAwayIfNoTelemetryComesAnyMore) {
  constexpr int kWithoutAnyTimeout = 10'000;
  for (const bool patient : {false, true}) {
    for (int at_ms = 3000; at_ms < 7700; at_ms += 197) {  // creeping, and from 6.7 s on at the wall
      begin(facing(0.1));
      if (patient) {
        auto parameters = robot::RemoteParameters::fetch(desk->client);
        parameters.stage("command_timeout", double{kWithoutAnyTimeout});
        parameters.apply();
      }
      WheelWatch watch(desk->client, robot.count_m);
      const std::uint64_t end_us = board().world_us() + static_cast<std::uint64_t>(at_ms) * 1000;
      bool silent = false;
      robot::DriveHooks hooks;
      hooks.interrupted = [&] {
        if (!silent && board().world_us() >= end_us) {
          silent = true;
          desk->client.request(protocol::SetTelemetry{0, 0});
        }
        return false;
      };
      {
        robot::DriveSession session(desk->client, hooks);
        const auto square = [&] { square_against_wall(session, watch, desk->client, robot, push_V, 0.3); };
        if (patient)
          EXPECT_THROW(square(), robot::LinkLost) << at_ms;
        else
          EXPECT_THROW(square(), robot::DriveFault) << at_ms;
      }
      EXPECT_TRUE(silent);
      EXPECT_EQ(mode(), patient ? protocol::Mode::disarmed : protocol::Mode::fault) << at_ms;
      EXPECT_EQ(board().motors().state(), sim::Bridge::coast) << at_ms;
      EXPECT_LE(board().wall_record().longest_stall_ticks, 1000) << at_ms;
      EXPECT_LE(board().wall_record().hardest_N, PushLimit{}.force_N) << at_ms;
    }
  }
}

TEST_F(Touching, PushesNoHarderForALargerLimitThanTheLimit) {
  for (const double force_N : {9.0, 10.0, 11.0, 12.0, 14.0, 16.0, 20.0, 24.0}) {
    begin(facing(0.05), 0.1);
    push_V = push_voltage_V({.force_N = force_N}, robot);
    EXPECT_NO_THROW(touch()) << force_N;
    EXPECT_LE(board().wall_record().hardest_N, force_N);
    EXPECT_LE(board().wall_record().longest_stall_ticks, 1000) << force_N;
  }
}

TEST_F(Touching, RefusesForcesThatCannotBe) {
  begin(facing(0.1));
  EXPECT_THAT([&] { push_voltage_V({.force_N = 2}, robot); }, ThrowsTelling(WallProblem::push_too_weak, "2"));
  EXPECT_THAT([&] { push_voltage_V({.force_N = 60}, robot); },
              ThrowsTelling(WallProblem::push_too_strong, "60"));
  // 12 N are 6 N a wheel, 0.216 N m; the data sheet's motor has 0.1528 N m for each volt.
  EXPECT_NEAR(push_V, 0.216 / 0.1528, 0.01);
}

TEST(PathOf, DrivesStraightInTruthWhatTheOdometryBelievesToBeAnArc) {
  sim::Config config;
  config.slip_m = 0;
  config.true_ed = 1.01;
  config.scale = 0.99;
  config.true_wheelbase_m = 0.295;
  const sim::Geometry geometry = sim::true_geometry(config);
  const calibration::WheelFactors actual{geometry.diameter_m[1] / 0.072, geometry.diameter_m[0] / 0.072,
                                         0.295};
  Desk desk(config);
  const calibration::WheelFactors loaded{1, 1, 0.29};
  robot::DriveSession session(desk.client);
  session.run(path_of({2, 0}, actual, loaded, {}));
  EXPECT_NEAR(desk.robot->board().truth().x_m, 2, 0.002);
  EXPECT_NEAR(desk.robot->board().truth().y_m, 0, 0.002);
  EXPECT_NEAR(desk.robot->board().truth().theta_rad, 0, 0.001);
  session.run(path_of({0, -3}, actual, loaded, {}));
  EXPECT_NEAR(desk.robot->board().truth().theta_rad, -6 * std::numbers::pi, 0.003);
  EXPECT_NEAR(desk.robot->board().truth().x_m, 2, 0.003);
}

TEST(ObstacleGuard, LetsARobotDriveAndStopsOneThatPushes) {
  for (const bool blocked : {false, true}) {
    sim::Config config = support::robot_before_a_wall(5);
    config.wall->x_m = 10;
    Desk desk(config);
    const WallRobot robot = wall_robot_of(robot::RemoteParameters::fetch(desk.client));
    WallDriver::Hooks hooks;
    hooks.interrupted = [&] {
      sim::Board& board = desk.robot->board();
      if (blocked && board.truth().x_m > 0.5) board.set_load(Side::left, {0, 100});
      return false;
    };
    WallDriver driver(desk.client, robot, push_voltage_V({}, robot), {0.7, 1.8}, hooks);
    const std::array legs{Leg{2, 0}, Leg{0, 0.5}, Leg{2, 0}, Leg{0, -0.5}};
    if (blocked) {
      EXPECT_THROW(driver.drive(legs, robot.loaded), RanIntoSomething);
      EXPECT_EQ(desk.client.request(protocol::GetStatus{}).latched_faults, 0U)
          << "before the robot found a stall";
    } else {
      driver.drive(legs, robot.loaded);
    }
    EXPECT_EQ(desk.client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
  }
}

}  // namespace
}  // namespace astro::wall
