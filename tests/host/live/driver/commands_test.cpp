#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/ros2/robot_on_ros.hpp"

namespace astro::live {
namespace {

using protocol::Mode;
using support::RobotOnRos;
using testing::HasSubstr;

class Commands : public testing::Test {
 protected:
  Commands() { bench.run_ms(300); }
  void arm() {
    const auto answer = bench.call("/arm");
    ASSERT_TRUE(answer.success) << answer.message;
  }
  void say_stamped(double v_mps, std::int64_t stamp_ns) {
    ros2::msg::TwistStamped message;
    message.header.stamp = ros2::msg::to_time(stamp_ns);
    message.twist.linear.x = v_mps;
    bench.ros.say("/cmd_vel", message);
  }
  double speed_mps() { return 1e-6 * support::drive_of(*bench.robot).twist().v_umps; }
  RobotOnRos bench;
};

TEST_F(Commands, ATwistDrivesTheArmedRobot) {
  arm();
  bench.drive_ms(1500, 0.3, 0);
  EXPECT_NEAR(speed_mps(), 0.3, 0.01);
}

TEST_F(Commands, ATwistStampedUnderTheSameNameDrivesItToo) {
  arm();
  for (int i = 0; i < 30; ++i) {
    say_stamped(0.3, bench.utc_ns());
    bench.run_ms(50);
  }
  EXPECT_NEAR(speed_mps(), 0.3, 0.01);
}

TEST_F(Commands, TheTopicHasOneTypeUnlessBothAreAskedForOrANameMayHaveSeveral) {
  const auto types = [](CommandType type, bool viewers) {
    test::FakeMiddleware ros;
    ros.types_share_names = viewers;
    DriverOptions options;
    options.cmd_vel_type = type;
    Driver driver(
        {&ros}, []() -> std::unique_ptr<robot::Transport> { throw Error("no port"); }, options);
    std::string all;
    for (const TopicDescription& each : ros.subscribed)
      if (each.name == "/cmd_vel")
        all += std::string(each.type.name.substr(each.type.name.rfind('/') + 1)) + ' ';
    return all;
  };
  EXPECT_EQ(DriverOptions().cmd_vel_type, CommandType::twist_stamped);
  EXPECT_EQ(types(CommandType::twist_stamped, false), "TwistStamped ");
  EXPECT_EQ(types(CommandType::twist, false), "Twist ");
  EXPECT_EQ(types(CommandType::both, false), "Twist TwistStamped ");
  EXPECT_EQ(types(CommandType::twist, true), "Twist TwistStamped ");
}

TEST_F(Commands, NothingArmsByItselfAndDiagnosticsSayWhyNothingMoves) {
  bench.drive_ms(500, 0.3, 0);
  EXPECT_EQ(bench.mode(), Mode::disarmed);
  bench.run_ms(1100);  // until the next report
  EXPECT_EQ(bench.status("commands").level, std::byte{1});
  EXPECT_THAT(bench.status("commands").message, HasSubstr("not armed"));
  EXPECT_EQ(bench.diagnosed("commands", "velocities ignored"), "10");
}

TEST_F(Commands, AVelocityHoldsForTheTimeOutAndThenTheRobotRampsToRestAndStaysArmed) {
  arm();
  bench.drive_ms(1000, 0.3, 0);
  bench.run_ms(440);  // the last one came 50 ms before
  EXPECT_EQ(bench.mode(), Mode::velocity);
  EXPECT_TRUE(bench.run_until([&] { return bench.mode() == Mode::stopping; }, 30));
  EXPECT_TRUE(bench.run_until([&] { return bench.mode() == Mode::idle; }));
  EXPECT_FALSE(bench.moves());
  bench.run_ms(5000);
  EXPECT_EQ(bench.mode(), Mode::idle);
  bench.drive_ms(500, 0.1, 0);
  EXPECT_EQ(bench.mode(), Mode::velocity);
}

TEST_F(Commands, ARobotWhoseDriverDiesStopsByItsOwnTimeOut) {
  arm();
  bench.drive_ms(1000, 0.3, 0);
  // The last frame was sent at most 50 ms ago; the robot's time-out is 200 ms, and it ramps at 0.5 m/s^2.
  bench.silence_ms(202);
  EXPECT_EQ(bench.mode(), Mode::stopping);
  bench.silence_ms(800);
  EXPECT_FALSE(bench.moves());
  EXPECT_EQ(bench.mode(), Mode::fault);
}

TEST_F(Commands, ATwistThatCameWhileTheDriverWasBusyHoldsNoLonger) {
  arm();
  bench.say_velocity(0.3, 0);
  bench.silence_ms(300);  // as while parameters are committed
  bench.run_ms(190);
  EXPECT_EQ(bench.mode(), Mode::velocity);
  EXPECT_TRUE(bench.run_until([&] { return bench.mode() == Mode::stopping; }, 20));
}

TEST_F(Commands, ATwistThatMayHaveWaitedForTheTimeOutMovesNothing) {
  arm();
  bench.say_velocity(0.3, 0);
  bench.silence_ms(600);
  bench.run_ms(100);
  EXPECT_EQ(bench.mode(), Mode::idle);
  EXPECT_THAT(bench.diagnosed("commands", "last ignored because"), HasSubstr("waited"));
}

TEST_F(Commands, AnOldStampMovesNothing) {
  arm();
  say_stamped(0.3, bench.utc_ns() - 501'000'000);
  bench.run_ms(250);  // reasons are told five times a second
  EXPECT_EQ(bench.mode(), Mode::idle);
  EXPECT_THAT(bench.diagnosed("commands", "last ignored because"), HasSubstr("old"));
}

TEST_F(Commands, NanMovesNothing) {
  arm();
  bench.say_velocity(std::nan(""), 0);
  bench.run_ms(250);  // reasons are told five times a second
  EXPECT_EQ(bench.mode(), Mode::idle);
  EXPECT_THAT(bench.diagnosed("commands", "last ignored because"), HasSubstr("NaN"));
}

TEST_F(Commands, ADamagedMessageMovesNothing) {
  arm();
  bench.ros.say_bytes("/cmd_vel", ros2::msg::Twist::kType, {0, 1, 0, 0, 1, 2, 3});
  bench.run_ms(250);  // reasons are told five times a second
  EXPECT_EQ(bench.mode(), Mode::idle);
  EXPECT_THAT(bench.diagnosed("commands", "last ignored because"), HasSubstr("damaged"));
}

TEST_F(Commands, AReasonThatChangesAllTheTimeIsToldFiveTimesASecondAtMost) {
  bench.run_ms(500);
  bench.ros.take<ros2::msg::DiagnosticArray>("/diagnostics");
  for (int i = 0; i < 50; ++i) {
    say_stamped(0.3, bench.utc_ns() - 1'000'000'000 - i * 20'000'000);  // later than the last, by ever more
    bench.run_ms(20);
  }
  const std::size_t told = bench.ros.take<ros2::msg::DiagnosticArray>("/diagnostics").size();
  EXPECT_GE(told, 2U);
  EXPECT_LE(told, 6U);
}

TEST_F(Commands, BeyondTheLimitsTheRobotKeepsTheCurvatureAndDiagnosticsSayIt) {
  arm();
  bench.drive_ms(4000, 3, 3);  // limits: 0.75 m/s, 2 rad/s
  EXPECT_NEAR(speed_mps(), 0.75, 0.02);
  EXPECT_NEAR(1e-6 * support::drive_of(*bench.robot).twist().omega_uradps, 0.75, 0.05);
  EXPECT_EQ(bench.diagnosed("commands", "reduced to the robot's limits"), "yes");
  bench.drive_ms(1000, 0.2, 0);
  EXPECT_EQ(bench.diagnosed("commands", "reduced to the robot's limits"), "no");
}

TEST_F(Commands, ReachTheWheelsWithinTwoTicksAndTheLink) {
  arm();
  bench.run_ms(100);
  bench.say_velocity(0.3, 0);
  const microseconds said = bench.now();
  ASSERT_TRUE(bench.run_until([&] { return bench.mode() == Mode::velocity; }, 20));
  // A tick until the driver looks, one for the request to arrive, and the robot's own.
  EXPECT_LE((bench.now() - said).count(), 3000);
}

TEST_F(Commands, AFaultEndsThePermissionToDrive) {
  arm();
  bench.drive_ms(500, 0.3, 0);
  bench.robot->board().battery().set_open_circuit_V(8);
  ASSERT_TRUE(bench.run_until([&] { return bench.mode() == Mode::fault; }));
  bench.robot->board().battery().set_open_circuit_V(12);
  bench.run_ms(1500);
  EXPECT_EQ(bench.status("robot").level, std::byte{2});
  EXPECT_EQ(bench.status("robot").message, "fault: under_voltage");
  EXPECT_TRUE(bench.call("/clear_faults").success);
  bench.drive_ms(500, 0.3, 0);
  EXPECT_EQ(bench.mode(), Mode::disarmed);
  EXPECT_FALSE(bench.moves());
}

TEST_F(Commands, EndBringsARobotThatWasArmedHereToRestAndDisarmsIt) {
  arm();
  bench.drive_ms(1000, 0.3, 0);
  bench.driver->end();
  EXPECT_EQ(bench.mode(), Mode::disarmed);
  EXPECT_FALSE(bench.moves());
}

TEST_F(Commands, EndLeavesARobotAloneThatWasNotArmedHere) {
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  other.request(protocol::Arm{});
  bench.driver->end();
  EXPECT_EQ(bench.mode(), Mode::idle);
}

}  // namespace
}  // namespace astro::live
