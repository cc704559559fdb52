#include <gmock/gmock.h>

#include <cmath>

#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/messages/std.hpp"
#include "tests/support/ros2/robot_on_ros.hpp"

namespace astro::live {
namespace {

using support::RobotOnRos;
using testing::ElementsAre;

/// On an arc to the left.
class DrivingRobot : public testing::Test {
 protected:
  DrivingRobot() {
    EXPECT_TRUE(bench.run_until([&] { return !bench.ros.published["/odom"].messages.empty(); }));
    EXPECT_TRUE(bench.call("/arm").success);
    bench.drive_ms(3000, 0.3, 0.5);
  }
  RobotOnRos bench;
};

TEST_F(DrivingRobot, OdometryIsWhereTheRobotIs) {
  const auto odometry = bench.ros.newest<ros2::msg::Odometry>("/odom");
  const sim::Pose truth = bench.robot->board().truth();
  // Without slip odometry and truth differ by what the robot does in a period and by rounding to counts.
  EXPECT_NEAR(odometry.pose.pose.position.x, truth.x_m, 0.01);
  EXPECT_NEAR(odometry.pose.pose.position.y, truth.y_m, 0.01);
  EXPECT_NEAR(ros2::heading_of(odometry.pose.pose.orientation), truth.theta_rad, 0.02);
  EXPECT_EQ(odometry.pose.pose.position.z, 0);
  EXPECT_NEAR(odometry.twist.twist.linear.x, 0.3, 0.01);
  EXPECT_NEAR(odometry.twist.twist.angular.z, 0.5, 0.03);
  EXPECT_EQ(odometry.twist.twist.linear.y, 0);
}

TEST_F(DrivingRobot, FramesAreThoseOfRep105) {
  const auto odometry = bench.ros.newest<ros2::msg::Odometry>("/odom");
  EXPECT_EQ(odometry.header.frame_id, "odom");
  EXPECT_EQ(odometry.child_frame_id, "base_footprint");
  const auto moving = bench.ros.newest<ros2::msg::TFMessage>("/tf").transforms;
  ASSERT_EQ(moving.size(), 3);
  EXPECT_EQ(moving[0].header.frame_id, "odom");
  EXPECT_EQ(moving[0].child_frame_id, "base_footprint");
  EXPECT_EQ(moving[1].header.frame_id, "base_link");
  EXPECT_EQ(moving[1].child_frame_id, "left_wheel");
  EXPECT_EQ(moving[2].child_frame_id, "right_wheel");
  const auto fixed = bench.ros.newest<ros2::msg::TFMessage>("/tf_static").transforms;
  ASSERT_EQ(fixed.size(), 1);
  EXPECT_EQ(fixed[0].header.frame_id, "base_footprint");
  EXPECT_EQ(fixed[0].child_frame_id, "base_link");
  EXPECT_EQ(fixed[0].transform, ros2::msg::Transform());
}

TEST_F(DrivingRobot, TransformsSayWhatOdometrySays) {
  const auto odometry = bench.ros.newest<ros2::msg::Odometry>("/odom");
  const auto base = bench.ros.newest<ros2::msg::TFMessage>("/tf").transforms.at(0);
  EXPECT_EQ(base.header.stamp, odometry.header.stamp);
  EXPECT_EQ(base.transform.translation.x, odometry.pose.pose.position.x);
  EXPECT_EQ(base.transform.translation.y, odometry.pose.pose.position.y);
  EXPECT_EQ(base.transform.rotation, odometry.pose.pose.orientation);
}

TEST_F(DrivingRobot, StampsAreWhenTheRobotMeasured) {
  bench.ros.take<ros2::msg::Odometry>("/odom");
  bench.say_velocity(0.3, 0.5);
  bench.run_ms(300);
  std::int64_t before_ns = 0;
  for (const auto& odometry : bench.ros.take<ros2::msg::Odometry>("/odom")) {
    const std::int64_t stamp_ns = ros2::msg::nanoseconds(odometry.header.stamp);
    if (before_ns != 0) {
      EXPECT_NEAR(1e-9 * static_cast<double>(stamp_ns - before_ns), 0.020, 0.001);  // 50 Hz
    }
    before_ns = stamp_ns;
  }
  // The last one was measured within the last period, and a round trip takes a few ticks.
  EXPECT_LE(before_ns, bench.utc_ns());
  EXPECT_GE(before_ns, bench.utc_ns() - 25'000'000);
}

TEST_F(DrivingRobot, JointsTurnAsTheWheelsDo) {
  bench.ros.take<ros2::msg::JointState>("/joint_states");
  bench.drive_ms(1000, 0.3, 0.5);
  const auto all = bench.ros.take<ros2::msg::JointState>("/joint_states");
  ASSERT_GT(all.size(), 45);
  const ros2::msg::JointState &first = all.front(), &last = all.back();
  EXPECT_THAT(first.name, ElementsAre("left_wheel_joint", "right_wheel_joint"));
  const double seconds = 1e-9 * static_cast<double>(ros2::msg::nanoseconds(last.header.stamp) -
                                                    ros2::msg::nanoseconds(first.header.stamp));
  for (const std::size_t i : {0U, 1U}) {
    const double rim_mps = 0.3 + (i == 0 ? -1 : 1) * 0.5 * 0.29 / 2;
    EXPECT_NEAR(last.velocity[i], rim_mps / 0.036, 0.3);
    EXPECT_NEAR((last.position[i] - first.position[i]) / seconds, rim_mps / 0.036, 0.05);
  }
}

TEST_F(DrivingRobot, DescriptionHasTheSizesOfTheRobot) {
  const std::string urdf = bench.ros.newest<ros2::msg::String>("/robot_description").data;
  EXPECT_THAT(urdf, testing::HasSubstr("<link name=\"base_footprint\"/>"));
  EXPECT_THAT(urdf, testing::HasSubstr("<origin xyz=\"0 0.145 0.036\"/>"));
}

TEST_F(DrivingRobot, TelemetrySaysWhatTheControllerDoes) {
  const auto telemetry = bench.ros.newest<ros2::msg::Telemetry>("/telemetry");
  EXPECT_EQ(telemetry.mode, "velocity");
  EXPECT_EQ(telemetry.faults, "");
  EXPECT_NEAR(telemetry.right_setpoint, 0.3 + 0.5 * 0.145, 1e-3);
  EXPECT_NEAR(telemetry.left_setpoint, 0.3 - 0.5 * 0.145, 1e-3);
  EXPECT_NEAR(telemetry.right_speed, telemetry.right_setpoint, 0.01);
  EXPECT_GT(telemetry.right_duty, telemetry.left_duty);
  EXPECT_NEAR(telemetry.linear_speed, 0.3, 0.01);
  EXPECT_GT(telemetry.right_counts, telemetry.left_counts);
  EXPECT_GT(telemetry.x_deviation, 0);
}

TEST_F(DrivingRobot, BatteryIsInVoltsAndWhatIsNotMeasuredIsNanOrUnknown) {
  const auto battery = bench.ros.newest<ros2::msg::BatteryState>("/battery_state");
  EXPECT_NEAR(battery.voltage, 12, 0.3);
  EXPECT_TRUE(std::isnan(battery.percentage));
  EXPECT_TRUE(std::isnan(battery.current));
  EXPECT_EQ(battery.power_supply_status, 0);  // it may be a charger
  EXPECT_TRUE(battery.present);
}

TEST_F(DrivingRobot, DiagnosticsComeOnceASecondAndSayThatAllIsWell) {
  bench.diagnostics();
  int messages = 0;
  for (int i = 0; i < 5; ++i) {
    bench.drive_ms(1000, 0.3, 0.5);
    messages += static_cast<int>(bench.ros.take<ros2::msg::DiagnosticArray>("/diagnostics").size());
  }
  EXPECT_NEAR(messages, 5, 1);
  bench.drive_ms(1000, 0.3, 0.5);
  for (const char* each : {"robot", "link", "commands"})
    EXPECT_EQ(bench.status(each).level, std::byte{0}) << bench.status(each).message;
  EXPECT_EQ(bench.diagnosed("robot", "mode"), "velocity");
  EXPECT_EQ(bench.diagnosed("commands", "velocities ignored"), "0");
}

TEST_F(DrivingRobot, CovarianceOfThePoseIsRowMajorAndGrows) {
  const auto first = bench.ros.newest<ros2::msg::Odometry>("/odom").pose.covariance;
  bench.drive_ms(3000, 0.3, 0.5);
  const auto last = bench.ros.newest<ros2::msg::Odometry>("/odom").pose.covariance;
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t column = 0; column < 6; ++column)
      EXPECT_EQ(last[6 * row + column], last[6 * column + row]);
  for (const std::size_t i : {0U, 7U, 35U}) EXPECT_GT(last[i], first[i]);
  for (const std::size_t i : {14U, 21U, 28U}) EXPECT_EQ(last[i], kNotMeasured);
}

TEST(Driver, PublishesAtTheChosenRate) {
  for (const double rate_hz : {10.0, 100.0, 1000.0}) {
    DriverOptions options;
    options.rate_hz = rate_hz;
    RobotOnRos bench(RobotOnRos::quiet(), options);
    bench.run_ms(1000);
    bench.ros.take<ros2::msg::Odometry>("/odom");
    bench.run_ms(1000);
    EXPECT_NEAR(static_cast<double>(bench.ros.take<ros2::msg::Odometry>("/odom").size()), rate_hz,
                1 + 0.01 * rate_hz);
  }
}

TEST(Driver, VelocitiesThatFlowDoNotKeepTheRobotsClockFromBeingMeasured) {
  RobotOnRos bench;
  bench.run_ms(300);
  EXPECT_TRUE(bench.call("/arm").success);
  for (int i = 0; i < 3000; ++i) {
    bench.say_velocity(0.1, 0.5);
    bench.run_ms(20);
  }
  // "< 0.002 s": half of the best round trip, and what the clocks may drift between two round trips.
  EXPECT_LT(std::stod(bench.diagnosed("link", "error of stamps").substr(2)), 0.005);
}

TEST(Driver, InANamespaceHasItsTopicsAndFramesThere) {
  DriverOptions options;
  options.node_namespace = "/left";
  RobotOnRos bench(RobotOnRos::quiet(), options);
  bench.run_ms(500);
  const auto odometry = bench.ros.newest<ros2::msg::Odometry>("/left/odom");
  EXPECT_EQ(odometry.header.frame_id, "left/odom");
  EXPECT_EQ(odometry.child_frame_id, "left/base_footprint");
  EXPECT_EQ(bench.ros.newest<ros2::msg::TFMessage>("/tf").transforms.at(2).child_frame_id,
            "left/right_wheel");
  EXPECT_THAT(bench.ros.newest<ros2::msg::String>("/left/robot_description").data,
              testing::HasSubstr("\"left/base_link\""));
  EXPECT_TRUE(bench.ros.services.contains("/left/arm"));
}

TEST(Driver, EncodesNothingForNobody) {
  RobotOnRos bench;
  bench.ros.anybody_listens = false;
  bench.run_ms(500);
  EXPECT_TRUE(bench.ros.published["/odom"].messages.empty());
  EXPECT_FALSE(bench.ros.published["/tf_static"].messages.empty());  // for whoever comes later
}

TEST(Driver, WarnsIfTheRobotHoldsOtherFactorsThanTheCalibrationWhoseCovarianceItPublishes) {
  DriverOptions options;
  options.calibrated = calibration::WheelFactors{1, 1, 0.29};
  RobotOnRos bench(RobotOnRos::quiet(), options);
  bench.run_ms(1500);
  EXPECT_EQ(bench.status("robot").level, std::byte{0});
  const ros2::msg::Parameter other{"c_R", to_parameter(1.001)};
  EXPECT_TRUE(bench.ros.parameters->set({&other, 1}).successful);
  bench.run_ms(1100);
  EXPECT_EQ(bench.status("robot").level, std::byte{1});
  EXPECT_THAT(bench.status("robot").message, testing::HasSubstr("other factors"));
}

TEST(Driver, TopicsServicesAndFramesGoByOtherNamesIfTheyAreChosen) {
  DriverOptions options;
  options.node_namespace = "left";
  options.names = {{{"/left/odom", "/hall/odometry"}, {"/tf", "/left/tf"}, {"/left/arm", "/left/ready"}},
                   "map_of_left",
                   "left/base_link"};
  RobotOnRos bench(RobotOnRos::quiet(), options);
  bench.run_ms(500);
  const auto odometry = bench.ros.newest<ros2::msg::Odometry>("/hall/odometry");
  EXPECT_EQ(odometry.header.frame_id, "map_of_left");
  EXPECT_EQ(odometry.child_frame_id, "left/base_link");
  EXPECT_EQ(bench.ros.newest<ros2::msg::TFMessage>("/left/tf").transforms.at(0).child_frame_id,
            "left/base_link");
  EXPECT_TRUE(bench.ros.services.contains("/left/ready"));
  EXPECT_FALSE(bench.ros.services.contains("/left/arm"));
  // base_link has one parent.
  EXPECT_TRUE(bench.ros.published["/tf_static"].messages.empty());
  EXPECT_THAT(bench.ros.newest<ros2::msg::String>("/left/robot_description").data,
              testing::Not(testing::HasSubstr("base_footprint")));
  EXPECT_EQ(bench.ros.parameters->value("base_frame_id").value().string_value, "left/base_link");
}

TEST(Driver, LeavesTheTransformOfOdometryToAnotherNodeIfItIsTold) {
  DriverOptions options;
  options.odom_tf = false;
  RobotOnRos bench(RobotOnRos::quiet(), options);
  bench.run_ms(500);
  for (const auto& each : bench.ros.newest<ros2::msg::TFMessage>("/tf").transforms)
    EXPECT_EQ(each.header.frame_id, "base_link");
  EXPECT_FALSE(bench.ros.take<ros2::msg::Odometry>("/odom").empty());
}

TEST(Driver, PutsTheParametersThatItWasGivenInForceOnceTheRobotIsFound) {
  std::vector<std::string> notices;
  DriverOptions options;
  options.robot_parameters = {{"c_R", to_parameter(1.002)}, {"of_another_node", to_parameter(5)}};
  options.notice = [&](const std::string& sentence) { notices.push_back(sentence); };
  RobotOnRos bench(RobotOnRos::quiet(), options);
  bench.run_ms(300);
  EXPECT_EQ(bench.ros.parameters->value("c_R").value().double_value, 1.002);
  EXPECT_THAT(notices, testing::Each(testing::HasSubstr("connected")));
}

TEST(Driver, RefusesAParameterAtTheStartThatAPersonHasToConfirm) {
  std::string notices;
  DriverOptions options;
  options.robot_parameters = {{"b", to_parameter(0.6)}};
  options.notice = [&](const std::string& sentence) { notices += sentence + '\n'; };
  RobotOnRos bench(RobotOnRos::quiet(), options);
  bench.run_ms(300);
  EXPECT_EQ(bench.ros.parameters->value("b").value().double_value, 0.29);
  EXPECT_THAT(notices, testing::HasSubstr("b would go from 0.29 m to 0.6 m"));
}

TEST(Driver, StampsAreTheTimeOfASimulationIfTheyAreToldToBe) {
  DriverOptions options = RobotOnRos::of_both_types();
  options.use_sim_time = true;
  RobotOnRos bench(RobotOnRos::quiet(), options);
  bench.run_ms(500);
  EXPECT_TRUE(bench.ros.take<ros2::msg::Odometry>("/odom").empty()) << "nobody has told the time";
  for (int i = 0; i < 10; ++i) {
    bench.ros.say("/clock", ros2::msg::Clock{ros2::msg::to_time(7'000'000'000 + i * 100'000'000)});
    bench.run_ms(50);
  }
  const auto told = bench.ros.take<ros2::msg::Odometry>("/odom");
  ASSERT_GE(told.size(), 9U);
  for (std::size_t i = 1; i < told.size(); ++i)
    EXPECT_GT(ros2::msg::nanoseconds(told[i].header.stamp), ros2::msg::nanoseconds(told[i - 1].header.stamp))
        << "one pose for each time";
  EXPECT_EQ(ros2::msg::nanoseconds(told.back().header.stamp), 7'900'000'000);
  // Velocities are stamped by the same clock.
  bench.call("/arm");
  ros2::msg::TwistStamped velocity;
  velocity.header.stamp = ros2::msg::to_time(7'900'000'000);
  velocity.twist.linear.x = 0.2;
  bench.ros.say("/cmd_vel", velocity);
  bench.run_ms(20);
  EXPECT_EQ(bench.mode(), protocol::Mode::velocity);
}

TEST(Driver, StampsChangeBetweenTheSystemsTimeAndThatOfASimulationWhileItRuns) {
  RobotOnRos bench;
  bench.run_ms(300);
  const auto use_sim_time = [&](bool on) {
    const ros2::msg::Parameter parameter{"use_sim_time", to_flag(on)};
    return bench.ros.parameters->set({&parameter, 1}).successful;
  };
  EXPECT_FALSE(bench.ros.parameters->value("use_sim_time").value().bool_value);
  ASSERT_TRUE(use_sim_time(true));
  bench.ros.take<ros2::msg::Odometry>("/odom");
  bench.run_ms(100);
  EXPECT_TRUE(bench.ros.take<ros2::msg::Odometry>("/odom").empty());
  bench.ros.say("/clock", ros2::msg::Clock{ros2::msg::to_time(5'000'000'000)});
  bench.run_ms(100);
  EXPECT_EQ(ros2::msg::nanoseconds(bench.ros.newest<ros2::msg::Odometry>("/odom").header.stamp),
            5'000'000'000);
  ASSERT_TRUE(use_sim_time(false));
  bench.run_ms(100);
  EXPECT_NEAR(1e-9 * static_cast<double>(
                         bench.utc_ns() -
                         ros2::msg::nanoseconds(bench.ros.newest<ros2::msg::Odometry>("/odom").header.stamp)),
              0, 0.05);
}

TEST(Driver, StampsFollowTheSystemsClockAtOnceWhenItIsSet) {
  RobotOnRos bench;
  bench.run_ms(1000);
  for (const std::int64_t hours : {1, -2}) {
    bench.utc_steps_ns = hours * 3'600'000'000'000;
    bench.ros.take<ros2::msg::Odometry>("/odom");
    bench.run_ms(60);
    const auto odometry = bench.ros.newest<ros2::msg::Odometry>("/odom");
    EXPECT_NEAR(1e-9 * static_cast<double>(bench.utc_ns() + bench.utc_steps_ns -
                                           ros2::msg::nanoseconds(odometry.header.stamp)),
                0, 0.05);
  }
}

TEST(OdometryWithGyro, IsPublishedOnceTheRobotUsesItsGyroAndKnowsWhatAKickDid) {
  sim::Config config = RobotOnRos::quiet();
  config.gyro.emplace();
  RobotOnRos bench(config);
  bench.run_ms(1000);
  EXPECT_TRUE(bench.ros.published["/odom_gyro"].messages.empty());
  bench.set_elsewhere("gyro_axis", 3);
  bench.run_ms(2000);
  ASSERT_FALSE(bench.ros.published["/odom_gyro"].messages.empty());
  const auto before = bench.ros.newest<ros2::msg::Odometry>("/odom_gyro");
  EXPECT_EQ(before.header.frame_id, "odom");
  EXPECT_EQ(before.child_frame_id, "base_footprint");
  constexpr double kKick_rad = 0.2;
  for (int i = 0; i < 100; ++i) {
    bench.robot->board().kick(kKick_rad / 100);
    bench.run_ms(1);
  }
  bench.run_ms(200);
  const auto after = bench.ros.newest<ros2::msg::Odometry>("/odom_gyro");
  // Noise of 0.025 degrees per root second in 0.3 s; a sample is a mean of 5 ms.
  EXPECT_NEAR(ros2::heading_of(after.pose.pose.orientation) - ros2::heading_of(before.pose.pose.orientation),
              kKick_rad, 0.002);
  EXPECT_NEAR(ros2::heading_of(bench.ros.newest<ros2::msg::Odometry>("/odom").pose.pose.orientation), 0, 1e-6)
      << "no wheel has turned";
  EXPECT_GT(after.pose.covariance[35], std::pow(0.009 * kKick_rad, 2)) << "of a scale that is known to 1 %";
}

TEST(OdometryWithGyro, HasTheYawRateOfTheWheelsWhileTheGyroDoesNotCount) {
  sim::Config config = RobotOnRos::quiet();
  config.gyro.emplace();
  RobotOnRos bench(config);
  bench.set_elsewhere("gyro_axis", 3);
  bench.run_ms(3000);
  bench.call("/arm");
  bench.drive_ms(1500, 0, 0.5);
  const auto counting = bench.ros.newest<ros2::msg::Odometry>("/odom_gyro");
  EXPECT_NEAR(counting.twist.twist.angular.z, 0.5, 0.05);
  EXPECT_GT(counting.twist.covariance[35], std::pow(0.004, 2)) << "4.4 mrad/s of noise in 10 ms";
  bench.robot->board().gyro().set_fault(sim::GyroFault::unplugged);
  bench.drive_ms(1000, 0, 0.5);
  EXPECT_NEAR(bench.ros.newest<ros2::msg::Odometry>("/odom_gyro").twist.twist.angular.z, 0.5, 0.05);
}

}  // namespace
}  // namespace astro::live
