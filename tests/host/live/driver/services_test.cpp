#include <gmock/gmock.h>

#include <cmath>

#include "host/formats/messages/ros_messages.hpp"
#include "tests/support/ros2/robot_on_ros.hpp"

namespace astro::live {
namespace {

using protocol::Mode;
using support::RobotOnRos;
using testing::HasSubstr;

class Services : public testing::Test {
 protected:
  Services() { bench.run_ms(300); }
  ros2::msg::PoseWithCovarianceStamped pose(double x_m, double y_m, double theta_rad) {
    ros2::msg::PoseWithCovarianceStamped message;
    message.header.frame_id = "odom";
    message.pose.pose = ros2::planar_pose(x_m, y_m, theta_rad);
    message.pose.covariance[0] = message.pose.covariance[7] = 0.04;
    message.pose.covariance[35] = 0.01;
    return message;
  }
  ros2::msg::Odometry odometry() {
    bench.ros.take<ros2::msg::Odometry>("/odom");
    bench.run_ms(60);
    return bench.ros.newest<ros2::msg::Odometry>("/odom");
  }
  /// Sets a pose while `lose` keeps one way of the line from carrying anything; the odometry once the line is good again.
  ros2::msg::Odometry set_pose_over_a_bad_line(void (support::Cable::*lose)(bool)) {
    EXPECT_EQ(odometry().pose.pose.position.x, 0);
    (bench.cable.*lose)(true);
    bench.ros.say("/set_pose", pose(1, 2, 0.5));
    bench.run_ms(1500);
    (bench.cable.*lose)(false);
    bench.run_ms(1500);
    return odometry();
  }

  std::vector<std::string> notices;
  RobotOnRos bench{RobotOnRos::quiet(), [this] {
                     DriverOptions options = RobotOnRos::of_both_types();
                     options.notice = [this](const std::string& sentence) { notices.push_back(sentence); };
                     return options;
                   }()};
};

TEST_F(Services, ArmAndDisarm) {
  EXPECT_EQ(bench.call("/arm"), (ros2::msg::Trigger::Response{true, "armed"}));
  EXPECT_EQ(bench.mode(), Mode::idle);
  EXPECT_TRUE(bench.call("/disarm").success);
  EXPECT_EQ(bench.mode(), Mode::disarmed);
}

TEST_F(Services, OnlyTheEmergencyStopIsAnsweredBeforeThoseThatWait) {
  for (const auto& [name, service] : bench.ros.services)
    EXPECT_EQ(service.urgent, name == "/emergency_stop") << name;
}

TEST_F(Services, ArmClearsWhatADeadDriveLeftBehindAndSaysSo) {
  bench.call("/arm");
  bench.drive_ms(500, 0.2, 0);
  bench.silence_ms(2000);
  ASSERT_EQ(bench.mode(), Mode::fault);
  bench.run_ms(100);
  const auto answer = bench.call("/arm");
  EXPECT_TRUE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("cleared command_timeout"));
  EXPECT_EQ(bench.mode(), Mode::idle);
}

TEST_F(Services, ArmRefusesAnyOtherFaultByItsName) {
  bench.call("/emergency_stop");
  EXPECT_EQ(bench.mode(), Mode::fault);
  const auto answer = bench.call("/arm");
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("emergency_stop"));
  EXPECT_TRUE(bench.call("/clear_faults").success);
  EXPECT_TRUE(bench.call("/arm").success);
}

TEST_F(Services, EmergencyStopOpensTheBridgesAtOnce) {
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  EXPECT_TRUE(bench.call("/emergency_stop").success);
  EXPECT_EQ(bench.robot->board().motors().state(), sim::Bridge::coast);
}

TEST_F(Services, AStopHoldsAgainstVelocitiesThatGoOnUntilTheRobotIsArmed) {
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  EXPECT_TRUE(bench.call("/stop").success);
  bench.drive_ms(3000, 0.3, 0);
  EXPECT_EQ(bench.mode(), Mode::idle);
  EXPECT_FALSE(bench.moves());
  EXPECT_THAT(bench.status("commands").message, HasSubstr("the robot was stopped and must be armed again"));
  bench.call("/arm");
  bench.drive_ms(100, 0.3, 0);
  EXPECT_EQ(bench.mode(), Mode::velocity);
}

TEST_F(Services, ARobotThatWasStoppedIsDisarmedAtTheEnd) {
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  bench.call("/stop");
  bench.driver->run([] { return false; });
  EXPECT_EQ(bench.mode(), Mode::disarmed);
}

class Obliging : public testing::Test {
 protected:
  Obliging() {
    bench.run_ms(300);
    bench.call("/arm");
    bench.drive_ms(500, 0.3, 0);
  }

  RobotOnRos bench{RobotOnRos::quiet(), [] {
                     DriverOptions options = RobotOnRos::of_both_types();
                     options.velocities_after_stop = true;
                     return options;
                   }()};
};

TEST_F(Obliging, NextVelocityAfterAStopDrivesAgain) {
  EXPECT_TRUE(bench.call("/stop").success);
  EXPECT_TRUE(bench.run_until([&] { return bench.mode() == Mode::idle; }));
  bench.drive_ms(100, 0.3, 0);
  EXPECT_EQ(bench.mode(), Mode::velocity);
}

TEST_F(Obliging, NextVelocityDoesNotDriveIfSomebodyElseHasStoppedTheRobotToo) {
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  for (const bool before : {true, false}) {
    if (before) other.request(protocol::Stop{});
    EXPECT_TRUE(bench.call("/stop").success);
    if (!before) other.request(protocol::Stop{});
    bench.drive_ms(3000, 0.3, 0);
    EXPECT_EQ(bench.mode(), Mode::idle) << before;
    EXPECT_FALSE(bench.moves()) << before;
    bench.call("/arm");
    bench.drive_ms(500, 0.3, 0);
    EXPECT_EQ(bench.mode(), Mode::velocity) << before;
  }
}

TEST_F(Services, StopHoldsAgainstAProgramAtAnotherPortThatRepeatsItsVelocity) {
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  other.request(protocol::Arm{});
  int refused = 0;
  const auto goes_on = [&](int ms) {
    for (int i = 0; i < ms; i += 50) {
      try {
        other.request(protocol::Velocity{300'000, 0});
      } catch (const robot::RobotRefused&) {
        ++refused;
      }
      bench.run_ms(50);
    }
  };
  goes_on(1000);
  ASSERT_TRUE(bench.moves());
  EXPECT_TRUE(bench.call("/stop").success);
  goes_on(3000);
  EXPECT_EQ(bench.mode(), Mode::idle);
  EXPECT_FALSE(bench.moves());
  EXPECT_EQ(refused, 60) << "each";
}

TEST_F(Services, AStopAtAnotherPortHoldsAgainstVelocitiesThatGoOn) {
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  other.request(protocol::Stop{});
  bench.drive_ms(3000, 0.3, 0);
  EXPECT_FALSE(bench.moves());
  EXPECT_THAT(bench.status("commands").message, HasSubstr("a velocity is ignored"));
}

TEST_F(Services, APauseHoldsAgainstVelocitiesUntilItIsResumed) {
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  EXPECT_TRUE(bench.call("/pause").success);
  bench.drive_ms(3000, 0.3, 0);
  EXPECT_EQ(bench.mode(), Mode::paused);
  EXPECT_FALSE(bench.moves());
  EXPECT_THAT(bench.status("commands").message, HasSubstr("the robot is paused"));
  EXPECT_TRUE(bench.call("/resume").success);
  bench.drive_ms(100, 0.3, 0);
  EXPECT_EQ(bench.mode(), Mode::velocity);
}

TEST_F(Services, APauseOfAnotherProgramEndsThePermissionAndArmGivesItBack) {
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  other.request(protocol::Pause{});
  bench.drive_ms(2000, 0.3, 0);
  EXPECT_EQ(bench.mode(), Mode::paused);
  EXPECT_TRUE(bench.call("/arm").success);
  bench.drive_ms(100, 0.3, 0);
  EXPECT_EQ(bench.mode(), Mode::velocity);
}

TEST_F(Services, APathThatAnotherProgramHasLeftIsNotTakenOver) {
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  other.request(protocol::Arm{});
  other.request(protocol::AddSegment{protocol::SegmentKind::line, 1, 1'000'000'000, 0, 0, 0, 0});
  bench.run_ms(50);
  const auto answer = bench.call("/arm");
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("drives, or waits on a path, for another program"));
}

TEST_F(Services, PauseNeedsAnArmedRobot) {
  const auto answer = bench.call("/pause");
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("arm it first"));
}

TEST_F(Services, PauseAndResumeTheDriveOfAnotherProgram) {
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  other.request(protocol::Arm{});
  other.request(protocol::AddSegment{protocol::SegmentKind::line, 1, 1'000'000'000, 0, 0, 0, 0});
  for (int i = 0; i < 10; ++i) bench.run_ms(50), other.pump({});
  ASSERT_EQ(bench.mode(), Mode::segment);
  EXPECT_THAT(bench.call("/resume").message, HasSubstr("was not paused"));
  EXPECT_TRUE(bench.call("/pause").success);
  for (int i = 0; i < 40; ++i) bench.run_ms(50), other.pump({});
  EXPECT_EQ(bench.mode(), Mode::paused);
  EXPECT_EQ(bench.call("/resume").message, "resumed");
  for (int i = 0; i < 10; ++i) bench.run_ms(50), other.pump({});
  EXPECT_EQ(bench.mode(), Mode::segment);
}

TEST_F(Services, ResetOdometryPutsThePoseAndItsCovarianceToZero) {
  bench.call("/arm");
  bench.drive_ms(1000, 0.3, 0.5);
  bench.run_ms(2000);
  EXPECT_TRUE(bench.call("/reset_odometry").success);
  const ros2::msg::Odometry now = odometry();
  EXPECT_EQ(now.pose.pose, ros2::planar_pose(0, 0, 0));
  EXPECT_LT(now.pose.covariance[0], 1e-8);  // a count
}

TEST_F(Services, ResetOdometryIsRefusedWhileTheRobotMoves) {
  bench.call("/arm");
  bench.drive_ms(1000, 0.3, 0);
  const auto answer = bench.call("/reset_odometry");
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("at rest"));
  EXPECT_GT(odometry().pose.pose.position.x, 0.1);
}

TEST_F(Services, SetPosePutsTheRobotThereWithTheCovarianceOfTheMessage) {
  bench.ros.say("/set_pose", pose(3, -2, 2.5));
  const ros2::msg::Odometry now = odometry();
  EXPECT_NEAR(now.pose.pose.position.x, 3, 1e-9);
  EXPECT_NEAR(now.pose.pose.position.y, -2, 1e-9);
  EXPECT_NEAR(ros2::heading_of(now.pose.pose.orientation), 2.5, 1e-9);
  EXPECT_NEAR(now.pose.covariance[0], 0.04, 1e-6);
  EXPECT_NEAR(now.pose.covariance[35], 0.01, 1e-6);
}

TEST_F(Services, NoOldPoseIsPublishedAfterOneWasSet) {
  DriverOptions options;
  options.rate_hz = 1000;
  RobotOnRos fast(RobotOnRos::quiet(), options);
  fast.run_ms(300);
  fast.ros.take<ros2::msg::Odometry>("/odom");
  fast.ros.say("/set_pose", pose(3, -2, 2.5));
  fast.run_ms(100);
  bool there = false;
  for (const auto& each : fast.ros.take<ros2::msg::Odometry>("/odom")) {
    there = there || each.pose.pose.position.x > 1;
    EXPECT_EQ(each.pose.covariance[0] > 0.01, each.pose.pose.position.x > 1);
    EXPECT_EQ(each.pose.pose.position.x > 1, there);
  }
  EXPECT_TRUE(there);
}

TEST_F(Services, AnErrorOfTheHeadingThatWasSetTurnsIntoOneOfThePlace) {
  bench.ros.say("/set_pose", pose(0, 0, 0));
  bench.run_ms(100);
  bench.call("/arm");
  bench.drive_ms(3000, 0.5, 0);
  bench.run_ms(2500);
  const ros2::msg::Odometry now = odometry();
  const double way_m = now.pose.pose.position.x;
  EXPECT_NEAR(now.pose.covariance[7], 0.04 + 0.01 * way_m * way_m, 0.002);
  EXPECT_NEAR(now.pose.covariance[0], 0.04, 0.001);
}

TEST_F(Services, SetPoseRefusesWhatIsNoPoseInItsFrame) {
  std::vector<std::pair<const char*, ros2::msg::PoseWithCovarianceStamped>> bad(6, {"", pose(1, 1, 0)});
  bad[0].first = "frame", bad[0].second.header.frame_id = "map";
  bad[1].first = "NaN", bad[1].second.pose.pose.position.x = std::nan("");
  bad[2].first = "length 0", bad[2].second.pose.pose.orientation = {0, 0, 0, 0};
  bad[3].first = "covariance", bad[3].second.pose.covariance[0] = -1;
  bad[4].first = "covariance", bad[4].second.pose.covariance[1] = 1;
  bad[5].first = "covariance", bad[5].second.pose.covariance[35] = std::nan("");
  for (const auto& [why, message] : bad) {
    bench.ros.say("/set_pose", message);
    EXPECT_EQ(odometry().pose.pose.position.x, 0) << why;
    bench.run_ms(1100);
    EXPECT_THAT(bench.diagnosed("robot", "last pose refused because"), HasSubstr(why));
    EXPECT_EQ(bench.status("robot").level, std::byte{1});
    EXPECT_THAT(bench.status("robot").message, HasSubstr("a pose was not set"));
    EXPECT_THAT(notices.back(), AllOf(HasSubstr("a pose was not set"), HasSubstr(why)));
  }
  bench.run_ms(3000);
  EXPECT_EQ(bench.status("robot").level, std::byte{0});
}

TEST_F(Services, WhoSetsARefusedPoseAgainAndAgainIsToldOnce) {
  auto refused = pose(1, 1, 0);
  refused.header.frame_id = "map";
  notices.clear();
  for (int i = 0; i < 20; ++i) {
    bench.ros.say("/set_pose", refused);
    bench.run_ms(100);
  }
  EXPECT_EQ(notices.size(), 1U);
}

TEST_F(Services, APoseWhoseAnswerWasLostIsSetWithItsCovarianceOnceTheRobotShowsIt) {
  const ros2::msg::Odometry now = set_pose_over_a_bad_line(&support::Cable::lose_answers);
  EXPECT_NEAR(now.pose.pose.position.x, 1, 1e-9);
  EXPECT_NEAR(now.pose.covariance[0], 0.04, 0.001);
  EXPECT_THAT(bench.diagnosed("robot", "odometry"), HasSubstr("the pose was set"));
}

TEST_F(Services, APoseWhoseRequestWasLostIsNotSetAndItsCovarianceStays) {
  const ros2::msg::Odometry now = set_pose_over_a_bad_line(&support::Cable::lose_requests);
  EXPECT_EQ(now.pose.pose.position.x, 0);
  EXPECT_LT(now.pose.covariance[0], 1e-6);
}

TEST_F(Services, SayThatThereIsNoRobot) {
  bench.cable.pull();
  bench.run_ms(100);
  for (const auto& [name, service] : bench.ros.services) {
    const microseconds before = bench.now();
    const auto answer = bench.call(name);
    EXPECT_FALSE(answer.success) << name;
    EXPECT_THAT(answer.message, HasSubstr("no robot")) << name;
    EXPECT_LT(bench.now() - before, std::chrono::seconds(1));
  }
}

TEST_F(Services, APoseThatAnotherProgramSetsIsNoticed) {
  bench.call("/arm");
  bench.drive_ms(2000, 0.3, 0);
  bench.run_ms(2500);
  bench.call("/disarm");
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  other.request(protocol::SetPose{});
  const ros2::msg::Odometry now = odometry();
  EXPECT_EQ(now.pose.pose.position.x, 0);
  EXPECT_LT(now.pose.covariance[0], 1e-8);
  bench.run_ms(1100);
  EXPECT_THAT(bench.diagnosed("robot", "odometry"), HasSubstr("another program"));
}

TEST_F(Services, APoseThatAnotherProgramSetsWhileTheCableIsPulledIsNoticed) {
  bench.call("/arm");
  bench.drive_ms(2000, 0.3, 0);
  bench.run_ms(2500);
  bench.call("/disarm");
  const double x_m = odometry().pose.pose.position.x;
  EXPECT_GT(x_m, 0.5);
  bench.cable.pull();
  bench.run_ms(500);
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  protocol::SetPose turned;
  turned.theta = std::uint64_t{1} << 62;  // at the same place, a quarter turn round
  turned.x = std::llround(std::ldexp(x_m, 40));
  other.request(turned);
  bench.cable.plug_in();
  bench.run_ms(1500);
  EXPECT_THAT(bench.diagnosed("robot", "odometry"), HasSubstr("another program"));
}

}  // namespace
}  // namespace astro::live
