#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "host/formats/messages/ros_messages.hpp"
#include "tests/support/ros2/robot_on_ros.hpp"

namespace astro::live {
namespace {

using protocol::Mode;
using std::chrono::milliseconds;
using support::RobotOnRos;
using testing::HasSubstr;

class Link : public testing::Test {
 protected:
  bool publishes() { return !bench.ros.take<ros2::msg::Odometry>("/odom").empty(); }
  bool comes_back() {
    bench.ros.take<ros2::msg::Odometry>("/odom");
    return bench.run_until([&] { return !bench.ros.published["/odom"].messages.empty(); });
  }
  ros2::msg::Odometry odometry() {
    EXPECT_TRUE(comes_back());
    return bench.ros.newest<ros2::msg::Odometry>("/odom");
  }
  /// Drives a bend for so long and comes to rest; the odometry then.
  ros2::msg::Odometry driven_ms(int ms) {
    EXPECT_TRUE(comes_back());
    bench.call("/arm");
    bench.drive_ms(ms, 0.3, 0.4);
    bench.run_ms(ms);
    return odometry();
  }
  /// The robot continues from there, and more uncertain by what a hand at its switch may have pushed it.
  void expect_continued(const ros2::msg::Odometry& before) {
    const ros2::msg::Odometry after = odometry();
    EXPECT_LT(distance(before, after), 1e-6);
    EXPECT_GE(after.pose.covariance[0], before.pose.covariance[0] + 0.01 * 0.01);
  }
  static double distance(const ros2::msg::Odometry& a, const ros2::msg::Odometry& b) {
    return std::hypot(a.pose.pose.position.x - b.pose.pose.position.x,
                      a.pose.pose.position.y - b.pose.pose.position.y);
  }
  RobotOnRos bench;
};

TEST_F(Link, WithoutARobotAtTheStartTheNodeWaitsForOne) {
  bench.cable.pull();
  bench.run_ms(3000);
  EXPECT_FALSE(publishes());
  EXPECT_EQ(bench.status("robot").level, std::byte{3});
  EXPECT_EQ(bench.status("link").level, std::byte{2});
  EXPECT_THAT(bench.status("link").message, HasSubstr("there is no port"));
  bench.cable.plug_in();
  EXPECT_TRUE(comes_back());
  bench.run_ms(1100);
  EXPECT_EQ(bench.status("link").level, std::byte{0});
}

TEST_F(Link, WhileTheCableIsPulledNoOdometryComesAndDiagnosticsSayWhy) {
  EXPECT_TRUE(comes_back());
  bench.cable.pull();
  bench.run_ms(50);
  publishes();
  bench.run_ms(2000);
  EXPECT_FALSE(publishes());
  EXPECT_EQ(bench.status("robot").level, std::byte{3});
  EXPECT_THAT(bench.status("link").message, HasSubstr("there is no port"));
}

TEST_F(Link, AfterThePullTheRobotIsNotArmedAgain) {
  EXPECT_TRUE(comes_back());
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  bench.cable.pull();
  bench.run_ms(50);
  bench.cable.plug_in();  // before the robot noticed anything
  EXPECT_TRUE(comes_back());
  bench.drive_ms(3000, 0.3, 0);
  EXPECT_FALSE(bench.moves());
  EXPECT_THAT(bench.diagnosed("commands", "last ignored because"), HasSubstr("not armed"));
  EXPECT_TRUE(bench.call("/arm").success);
  bench.drive_ms(500, 0.3, 0);
  EXPECT_EQ(bench.mode(), Mode::velocity);
}

TEST_F(Link, ARobotWithoutATimeOutOfItsOwnIsStoppedOnceTheLinkIsBack) {
  EXPECT_TRUE(comes_back());
  bench.set_elsewhere("command_timeout", 0);  // it would drive on for ever
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  bench.cable.pull();
  bench.run_ms(2000);
  ASSERT_TRUE(bench.moves());
  bench.cable.plug_in();
  EXPECT_TRUE(comes_back());
  bench.run_ms(1500);  // a ramp from 0.3 m/s at 0.5 m/s^2
  EXPECT_FALSE(bench.moves());
}

/// Another host drives the robot over its other port.
class OtherHost {
 public:
  explicit OtherHost(RobotOnRos& bench)
      : client_(std::make_unique<simulation::InProcessTransport>(bench.robot, 1)) {
    client_.connect();
    client_.request(protocol::Arm{});
    drive();
  }
  void drive() { client_.request(protocol::Velocity{300'000, 0}); }

 private:
  robot::Client client_;
};

TEST_F(Link, ARobotThatAKilledProgramLeftDrivingWithoutATimeOutIsStoppedAtTheStart) {
  for (const double timeout_ms : {0.0, 5000.0}) {
    RobotOnRos left;
    left.set_elsewhere("command_timeout", timeout_ms);
    OtherHost killed(left);
    left.silence_ms(1000);
    ASSERT_TRUE(left.moves());
    left.run_ms(300);
    EXPECT_EQ(left.mode(), Mode::stopping) << timeout_ms;
    left.run_ms(1500);
    EXPECT_FALSE(left.moves());
    EXPECT_EQ(left.mode(), Mode::idle);
  }
}

TEST_F(Link, ARobotThatIsFoundDrivingOnASlowLineIsStoppedBeforeItsParametersAreRead) {
  constexpr int kRoundTrip_ms = 40;
  RobotOnRos left;
  left.set_elsewhere("command_timeout", 0);
  OtherHost killed(left);
  left.cable.delay_ms(kRoundTrip_ms);
  left.driver->step();
  EXPECT_EQ(left.mode(), Mode::stopping);
  EXPECT_LE(left.now(), milliseconds(12 * kRoundTrip_ms)) << "the table alone takes 80 round trips";
}

TEST_F(Link, StopsFromTheFirstStepOnAndArmsOnceParametersAreKnown) {
  constexpr int kRoundTrip_ms = 40;
  RobotOnRos fresh;
  fresh.cable.delay_ms(kRoundTrip_ms);
  fresh.driver->step();
  EXPECT_EQ(fresh.ros.parameters->descriptors().size(), 8) << "those of the node alone";
  EXPECT_FALSE(fresh.ros.parameters->is_fresh()) << "who asks for others waits";
  EXPECT_THAT(fresh.call("/arm").message, HasSubstr("not known yet: call again"));
  const microseconds before = fresh.now();
  EXPECT_TRUE(fresh.call("/stop").success);
  EXPECT_TRUE(fresh.call("/emergency_stop").success);
  EXPECT_LE(fresh.now() - before, milliseconds(4 * kRoundTrip_ms));
  EXPECT_EQ(fresh.ros.parameters->descriptors().size(), 8) << "still";
  EXPECT_TRUE(fresh.run_until([&] { return fresh.ros.parameters->descriptors().size() > 40; }, 20'000));
  EXPECT_TRUE(fresh.run_until([&] { return !fresh.ros.published["/odom"].messages.empty(); }));
  EXPECT_TRUE(fresh.call("/clear_faults").success);
  EXPECT_TRUE(fresh.call("/arm").success);
}

// Else it might drive before it has been told where it stands, and be told so after the drive.
TEST_F(Link, AfterARestartOnASlowLineTheRobotIsArmedOnceItKnowsItsPose) {
  EXPECT_TRUE(comes_back());
  bench.call("/arm");
  bench.drive_ms(2000, 0.3, 0);
  bench.run_ms(1500);
  const auto off_m = [&] { return odometry().pose.pose.position.x - bench.robot->board().truth().x_m; };
  const double off_before_m = off_m();
  bench.cable.delay_ms(40);
  bench.robot->restart(hal::ResetCause::software);
  int refused = 0;
  EXPECT_TRUE(bench.run_until(
      [&] {
        const bool armed = bench.call("/arm").success;
        refused += armed ? 0 : 1;
        return armed;
      },
      20'000));
  EXPECT_GT(refused, 0);
  bench.drive_ms(2000, 0.3, 0);
  bench.run_ms(1500);
  EXPECT_NEAR(off_m(), off_before_m, 0.003);  // it was not told where it stood before the drive
}

TEST_F(Link, ThatIsLostWhileParametersAreSetAtTheStartIsLostAndFoundAgain) {
  DriverOptions options = RobotOnRos::of_both_types();
  options.robot_parameters = {{"c_R", to_parameter(1.002)}};
  for (int writes = 90; writes < 110; ++writes) {  // from the last rows of the table to the commit and beyond
    RobotOnRos breaks(RobotOnRos::quiet(), options);
    breaks.cable.pull_after(writes);
    breaks.run_ms(1000);
    breaks.cable.plug_in();
    EXPECT_TRUE(breaks.run_until([&] { return breaks.ros.parameters->descriptors().size() > 40; })) << writes;
  }
}

TEST_F(Link, ARobotThatIsDrivenOverItsOtherPortDrivesOnThroughTheStart) {
  RobotOnRos driven;
  driven.set_elsewhere("command_timeout", 1000);  // longer than a node takes to shake hands
  OtherHost host(driven);
  for (int i = 0; i < 40; ++i) {
    driven.run_ms(50);
    host.drive();  // throws if it was refused
    ASSERT_EQ(driven.mode(), Mode::velocity);
  }
  EXPECT_FALSE(driven.ros.take<ros2::msg::Odometry>("/odom").empty());
}

TEST_F(Link, AHundredPullsWhileItDrivesEachStopTheRobotAndEachIsRecoveredWithoutAJump) {
  constexpr unsigned kSeed = 20261124;
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> before(50, 600), away(250, 3000);
  std::uniform_real_distribution<double> v_mps(-0.4, 0.5), omega_radps(-1, 1);
  EXPECT_TRUE(comes_back());
  double worst_m = 0;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(bench.run_until([&] { return bench.call("/arm").success; })) << i;
    const double v = v_mps(random), omega = omega_radps(random);
    bench.drive_ms(before(random), v, omega);
    bench.cable.pull();
    const int away_ms = away(random);
    for (int ms = 0; ms < away_ms; ms += 50) {
      bench.say_velocity(v, omega);  // it goes on
      bench.run_ms(50);
    }
    // By its own time-out, and its ramp from at most 0.5 m/s at 0.5 m/s^2.
    for (int ms = 0; bench.mode() != Mode::fault && ms < 1500; ++ms) bench.silence_ms(1);
    ASSERT_EQ(bench.mode(), Mode::fault) << i;
    ASSERT_FALSE(bench.moves()) << i;
    const sim::Pose truth = bench.robot->board().truth();
    bench.cable.plug_in();
    const ros2::msg::Odometry odometry = this->odometry();
    const double off_m =
        std::hypot(odometry.pose.pose.position.x - truth.x_m, odometry.pose.pose.position.y - truth.y_m);
    worst_m = std::max(worst_m, off_m);
    bench.drive_ms(200, 0.3, 0);
    ASSERT_FALSE(bench.moves()) << i;
  }
  std::printf("100 pulls, seed %u: all stopped, all recovered; odometry at most %.2f mm off\n", kSeed,
              1e3 * worst_m);
  // Without slip odometry is off by the rounding of counts and of the robot's arcs: 0.1 mm a drive.
  EXPECT_LT(worst_m, 0.01);
}

TEST_F(Link, AfterARestartOdometryContinuesFromTheLastPoseWithALargerCovariance) {
  const ros2::msg::Odometry before = driven_ms(2000);
  bench.robot->restart(hal::ResetCause::software);
  const ros2::msg::Odometry after = odometry();
  EXPECT_LT(distance(before, after), 1e-6);
  EXPECT_NEAR(ros2::heading_of(before.pose.pose.orientation), ros2::heading_of(after.pose.pose.orientation),
              1e-6);
  EXPECT_GE(after.pose.covariance[0], before.pose.covariance[0] + 0.01 * 0.01);
  EXPECT_GE(after.pose.covariance[35], before.pose.covariance[35] + 0.02 * 0.02);
  bench.run_ms(1100);
  EXPECT_THAT(bench.diagnosed("robot", "odometry"), HasSubstr("has restarted"));
  EXPECT_EQ(bench.mode(), Mode::disarmed);
}

TEST_F(Link, ARestartBehindAPulledCableIsFound) {
  const ros2::msg::Odometry before = driven_ms(2000);
  bench.cable.pull();
  bench.run_ms(500);
  bench.robot->restart(hal::ResetCause::power_on);
  bench.run_ms(500);
  bench.cable.plug_in();
  expect_continued(before);
}

// Its counts and its pose are not zero then.
TEST_F(Link, ARestartIsFoundByTheRobotsClockIfTheRobotHasMovedSince) {
  const ros2::msg::Odometry before = driven_ms(2000);
  bench.cable.pull();
  bench.run_ms(500);
  bench.robot->restart(hal::ResetCause::power_on);
  bench.silence_ms(100);
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  other.request(protocol::Arm{});
  other.request(protocol::Velocity{200'000, 300'000});
  bench.silence_ms(2000);  // its time-out ends that
  EXPECT_FALSE(bench.moves());
  bench.cable.plug_in();
  expect_continued(before);
}

TEST_F(Link, ARestartWhileTheComputerSleptIsFoundByCountsAndPoseOfZero) {
  const ros2::msg::Odometry before = driven_ms(2000);
  bench.cable.pull();
  bench.run_ms(500);
  bench.robot->restart(hal::ResetCause::power_on);
  bench.sleep_ms(120'000);
  bench.cable.plug_in();
  expect_continued(before);
}

TEST_F(Link, ARestartSoonAfterAStartIsFoundAlsoAfterALongGap) {
  const ros2::msg::Odometry before = driven_ms(1500);
  bench.cable.pull();
  bench.run_ms(500);
  bench.robot->restart(hal::ResetCause::power_on);
  bench.silence_ms(120'000);
  bench.cable.plug_in();
  expect_continued(before);
}

TEST_F(Link, ARobotThatRanOnThroughALongGapIsNotTakenForOneThatHasRestarted) {
  const ros2::msg::Odometry before = driven_ms(1500);
  bench.cable.pull();
  bench.silence_ms(120'000);
  bench.cable.plug_in();
  const ros2::msg::Odometry after = odometry();
  EXPECT_LT(distance(before, after), 1e-6);
  EXPECT_NEAR(after.pose.covariance[0], before.pose.covariance[0], 1e-9);
}

TEST_F(Link, ARobotThatRestartsWhileItRollsIsAtMostAsFarOffAsItSays) {
  EXPECT_TRUE(comes_back());
  bench.call("/arm");
  bench.drive_ms(2000, 0.5, 0);
  bench.robot->restart(hal::ResetCause::watchdog);
  bench.run_ms(4000);
  const ros2::msg::Odometry after = odometry();
  const double off_m = std::abs(bench.robot->board().truth().x_m - after.pose.pose.position.x);
  EXPECT_LT(off_m, 2 * std::sqrt(after.pose.covariance[0]));
  EXPECT_FALSE(bench.moves());
}

TEST_F(Link, AnotherRobotAtThePortIsNotTakenForTheFirst) {
  EXPECT_TRUE(comes_back());
  auto config = RobotOnRos::quiet();
  config.seed = 77;
  const auto first = bench.robot;
  const auto other = std::make_shared<simulation::VirtualRobot>(config, simulation::MocapConfig{});
  bench.ros.on_wait = [&](microseconds most) {
    for (int i = 0; i < most.count() / 1000; ++i) first->step();
  };
  bench.cable.pull();
  bench.run_ms(100);
  bench.cable.exchange_robot(other);
  bench.cable.plug_in();
  publishes();
  bench.run_ms(2000);
  EXPECT_FALSE(publishes());
  EXPECT_THAT(bench.status("link").message, HasSubstr("another robot"));
  bench.cable.exchange_robot(first);
  EXPECT_TRUE(comes_back());
}

TEST_F(Link, ARobotIsAtRestAndDisarmedWhenAMiddlewareFails) {
  EXPECT_TRUE(comes_back());
  bench.set_elsewhere("command_timeout", 0);  // it would drive on for ever
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  ASSERT_TRUE(bench.moves());
  bench.ros.fail_at_next_poll();
  EXPECT_THROW(bench.driver->run([] { return true; }), Error);
  EXPECT_FALSE(bench.moves());
  EXPECT_EQ(bench.mode(), Mode::disarmed);
}

TEST_F(Link, ARobotIsAtRestAndDisarmedWhenItsDriverIsToldToEnd) {
  EXPECT_TRUE(comes_back());
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  int steps = 20;
  bench.driver->run([&] { return --steps > 0; });
  EXPECT_FALSE(bench.moves());
  EXPECT_EQ(bench.mode(), Mode::disarmed);
}

TEST_F(Link, EndsWithoutARobotAndWithoutAnError) {
  bench.cable.pull();
  bench.run_ms(100);
  EXPECT_NO_THROW(bench.driver->end());
}

TEST_F(Link, SeveralMiddlewaresGetTheSameAndMayAllCommand) {
  test::FakeMiddleware first, second;  // those of the rig still hold what its own driver had them call
  DriverOptions options = RobotOnRos::of_both_types();
  options.clock = {[this] { return bench.now(); }, [this] { return bench.utc_ns(); }};
  bench.driver.reset();
  Driver driver(
      {&first, &second}, [this] { return bench.cable.open(); }, options);
  const auto run_ms = [&](int ms) {
    const microseconds until = bench.now() + std::chrono::milliseconds(ms);
    while (bench.now() < until) driver.step();
  };
  run_ms(500);
  const auto first_got = first.take<ros2::msg::Odometry>("/odom");
  EXPECT_FALSE(first_got.empty());
  EXPECT_EQ(first_got, second.take<ros2::msg::Odometry>("/odom"));
  EXPECT_TRUE(second.call<ros2::msg::Trigger>("/arm").success);
  ros2::msg::Twist twist;
  twist.linear.x = 0.2;
  first.say("/cmd_vel", twist);
  run_ms(100);
  EXPECT_EQ(bench.mode(), Mode::velocity);
}

}  // namespace
}  // namespace astro::live
