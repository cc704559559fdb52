#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/support/ros2/robot_on_ros.hpp"

namespace astro::live {
namespace {

using support::RobotOnRos;
using testing::HasSubstr;

class Parameters : public testing::Test {
 protected:
  Parameters() { bench.run_ms(300); }
  /// After whatever waiting a middleware would do.
  ParameterTable& table() {
    EXPECT_TRUE(bench.run_until([&] { return bench.ros.parameters->is_fresh(); }));
    return *bench.ros.parameters;
  }
  double real(std::string_view name) { return table().value(name).value().double_value; }
  ros2::msg::ParameterDescriptor descriptor(std::string_view name) {
    for (const auto& each : table().descriptors())
      if (each.name == name) return each;
    ADD_FAILURE() << "no descriptor of " << name;
    return {};
  }
  static ros2::msg::ParameterValue whole(std::int64_t value) {
    ros2::msg::ParameterValue parameter;
    parameter.type = static_cast<std::uint8_t>(ParameterType::integer);
    parameter.integer_value = value;
    return parameter;
  }
  ros2::msg::SetParametersResult set(std::initializer_list<ros2::msg::Parameter> parameters) {
    return table().set({parameters.begin(), parameters.size()});
  }
  RobotOnRos bench;
};

TEST_F(Parameters, AreTheRobotsWithTypesRangesAndUnits) {
  const auto b = descriptor("b");
  EXPECT_EQ(b.type, static_cast<std::uint8_t>(ParameterType::real));
  EXPECT_THAT(b.description, testing::AllOf(HasSubstr("Wheelbase"), HasSubstr("[m]")));
  EXPECT_EQ(b.floating_point_range, (ros2::msg::FloatingPointRange{0.05, 2, 0}));
  const auto timeout = descriptor("command_timeout");
  EXPECT_EQ(timeout.integer_range, (ros2::msg::IntegerRange{0, 60'000, 1}));
  EXPECT_EQ(descriptor("robot_name").type, static_cast<std::uint8_t>(ParameterType::text));
  EXPECT_EQ(real("c_R"), 1);
  EXPECT_EQ(table().value("robot_name").value().string_value, "ASTRO");
  EXPECT_EQ(table().value("command_timeout").value().integer_value, 200);
  EXPECT_FALSE(table().value("no_such_parameter"));
}

TEST_F(Parameters, EveryDescriptorHasAValueOfItsType) {
  for (const auto& each : table().descriptors())
    EXPECT_EQ(table().value(each.name).value().type, each.type) << each.name;
  EXPECT_GT(table().descriptors().size(), 40);
}

TEST_F(Parameters, ASetIsPutInForceAsAWholeAndReadBack) {
  EXPECT_TRUE(set({{"c_R", to_parameter(1.002)}, {"b", to_parameter(0.2886)}}).successful);
  EXPECT_EQ(real("c_R"), 1.002) << "as it was set, though the robot holds 1.0020000003278255";
  EXPECT_EQ(real("b"), 0.2886);
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  EXPECT_NEAR(robot::RemoteParameters::fetch(other).number("c_R"), 1.002, 1e-9);
}

TEST_F(Parameters, OneBadValueRefusesTheWholeSetAndIsNamed) {
  const auto result = set({{"c_R", to_parameter(1.002)}, {"b", to_parameter(5)}});
  EXPECT_FALSE(result.successful);
  EXPECT_THAT(result.reason, testing::AllOf(HasSubstr("b = 5 m"), HasSubstr("0.05 m to 2 m")));
  EXPECT_EQ(real("c_R"), 1);
  // What was staged then is not in the next set.
  EXPECT_TRUE(set({{"kp", to_parameter(50)}}).successful);
  EXPECT_EQ(real("c_R"), 1);
}

TEST_F(Parameters, ARuleBetweenTwoIsNamedByTheRobot) {
  const auto result = set({{"over_speed", to_parameter(0.7)}});
  EXPECT_FALSE(result.successful);
  EXPECT_THAT(result.reason, testing::AllOf(HasSubstr("over_speed"), HasSubstr("speed_limit")));
}

TEST_F(Parameters, ReadBackAsTheyWereSet) {
  for (const char* name : {"c_R", "c_L", "kp", "e"}) {
    const double value = std::string_view(name) == "kp"  ? 61.3
                         : std::string_view(name) == "e" ? 0.013
                                                         : 0.998;
    ASSERT_TRUE(set({{name, to_parameter(value)}}).successful) << name;
    EXPECT_EQ(real(name), value) << name;
  }
}

TEST_F(Parameters, AValueThatAPersonHasToConfirmIsRefusedWithWhatWouldChange) {
  EXPECT_THAT(set({{"command_timeout", whole(0)}}).reason,
              testing::AllOf(HasSubstr("command_timeout would go from 200 ms to 0 ms"),
                             HasSubstr("keeps driving if its host disappears"), HasSubstr("confirm")));
  EXPECT_EQ(table().value("command_timeout").value().integer_value, 200);
  EXPECT_THAT(set({{"b", to_parameter(0.35)}}).reason,
              HasSubstr("b would go from 0.29 m to 0.35 m, +20.7 %"));
  EXPECT_FALSE(set({{"kp", to_parameter(600)}}).successful);
  EXPECT_FALSE(set({{"motor_polarity_left", whole(-1)}}).successful);
  // None of a set in which there is one.
  EXPECT_FALSE(set({{"c_R", to_parameter(1.002)}, {"speed_limit", to_parameter(0.075)}}).successful);
  EXPECT_EQ(real("c_R"), 1);
  EXPECT_TRUE(set({{"speed_limit", to_parameter(0.5)}}).successful);
}

TEST_F(Parameters, AreRefusedWhileTheRobotDrives) {
  bench.call("/arm");
  bench.drive_ms(500, 0.3, 0);
  const auto result = set({{"c_R", to_parameter(1.002)}});
  EXPECT_FALSE(result.successful);
  EXPECT_THAT(result.reason, HasSubstr("at rest"));
}

TEST_F(Parameters, AreRefusedInAnotherTypeButAWholeNumberMayStandForARealOne) {
  EXPECT_THAT(set({{"c_R", to_parameter(std::string("1"))}}).reason, HasSubstr("c_R"));
  EXPECT_TRUE(set({{"c_R", whole(1)}}).successful);
  EXPECT_FALSE(set({{"command_timeout", to_parameter(0.3)}}).successful);
  EXPECT_FALSE(set({{"c_R", to_parameter(std::nan(""))}}).successful);
  EXPECT_THAT(set({{"nonsense", to_parameter(1)}}).reason, HasSubstr("nonsense"));
}

TEST_F(Parameters, OfTheNodeCanBeReadAndNotSet) {
  EXPECT_EQ(table().value("odom_frame_id").value().string_value, "odom");
  EXPECT_EQ(real("cmd_vel_timeout"), 0.5);
  EXPECT_EQ(real("publish_rate"), 50);
  EXPECT_TRUE(descriptor("publish_rate").read_only);
  EXPECT_THAT(set({{"publish_rate", to_parameter(10)}}).reason, HasSubstr("publish_rate"));
}

TEST_F(Parameters, ThatAnotherProgramChangesAreSeenAfterASecond) {
  real("c_R");
  robot::Client other(std::make_unique<simulation::InProcessTransport>(bench.robot, 1));
  other.connect();
  auto parameters = robot::RemoteParameters::fetch(other);
  parameters.stage("c_R", 1.003);
  parameters.commit();
  bench.run_ms(1100);
  EXPECT_NEAR(real("c_R"), 1.003, 1e-9);
}

TEST_F(Parameters, AreNotReadAgainWhileTheRobotIsArmed) {
  real("c_R");
  bench.call("/arm");
  bench.run_ms(1500);
  const microseconds before = bench.now();
  real("c_R");
  EXPECT_EQ(bench.now(), before) << "a request to the robot takes time";
  bench.call("/disarm");
  real("c_R");
  EXPECT_GT(bench.now(), before);
}

TEST_F(Parameters, AreReadALittleAtATimeOnASlowLineSoThatAStopNeverWaitsForTheTable) {
  constexpr int kRoundTrip_ms = 40;
  bench.cable.delay_ms(kRoundTrip_ms);
  bench.set_elsewhere("c_R", 1.003);
  bench.run_ms(1500);
  ASSERT_FALSE(bench.ros.parameters->is_fresh()) << "they are older than a second";
  microseconds longest{};
  int steps = 0;
  for (; !bench.ros.parameters->is_fresh(); ++steps) {
    const microseconds before = bench.now();
    bench.driver->step();
    longest = std::max(longest, bench.now() - before);
    ASSERT_LT(steps, 1000);
  }
  // A step may read one value, send a Ping and ask for telemetry.
  EXPECT_LE(longest, std::chrono::milliseconds(4 * kRoundTrip_ms));
  EXPECT_GT(steps, 30) << "one for nearly each parameter";
  EXPECT_NEAR(bench.ros.parameters->value("c_R").value().double_value, 1.003, 1e-9);
}

TEST_F(Parameters, ASetOfManyLooksForAStopBetweenItsRequests) {
  const std::vector<ros2::msg::Parameter> many{{"c_R", to_parameter(1.002)}, {"c_L", to_parameter(0.998)},
                                               {"b", to_parameter(0.2886)},  {"kp", to_parameter(61)},
                                               {"ki", to_parameter(1210)},   {"e", to_parameter(0.01)}};
  int looks = 0;
  microseconds longest{}, last = bench.now();
  bench.cable.delay_ms(40);
  bench.ros.on_urgent = [&] {
    longest = std::max(longest, bench.now() - last);
    last = bench.now();
    if (++looks == 4) {
      EXPECT_TRUE(bench.call("/emergency_stop").success);
    }
  };
  const std::string reason = table().set(many).reason;
  EXPECT_GE(looks, 2 * static_cast<int>(many.size())) << "each is sent and read back; " << reason;
  EXPECT_EQ(bench.mode(), protocol::Mode::fault);
  // The first look comes after the status and the opening of the staging area; a commit writes flash.
  EXPECT_LE(longest, std::chrono::milliseconds(40 * 4 + 250));
}

TEST_F(Parameters, ASetWhoseLinkIsLostByWhatCameInBetweenIsRefused) {
  bench.ros.on_urgent = [&] {
    bench.cable.pull();
    bench.call("/emergency_stop");  // by which the driver notices
  };
  EXPECT_THAT(set({{"c_R", to_parameter(1.002)}}).reason, HasSubstr("lost while its parameters were set"));
  EXPECT_EQ(bench.ros.parameters->descriptors().size(), 8);
}

TEST_F(Parameters, NewSizesAreInTheNextDescription) {
  bench.ros.take<ros2::msg::String>("/robot_description");
  EXPECT_TRUE(set({{"b", to_parameter(0.3)}}).successful);
  const auto told = bench.ros.take<ros2::msg::String>("/robot_description");
  ASSERT_EQ(told.size(), 1);
  EXPECT_THAT(told[0].data, HasSubstr("0 0.15 0.036"));
}

TEST_F(Parameters, KeepThePoseAndItsCovarianceWhenTheyChange) {
  bench.call("/arm");
  bench.drive_ms(3000, 0.3, 0.2);
  bench.run_ms(2500);
  const auto before = bench.ros.newest<ros2::msg::Odometry>("/odom");
  EXPECT_TRUE(set({{"c_R", to_parameter(1.004)}}).successful);
  bench.run_ms(100);
  const auto after = bench.ros.newest<ros2::msg::Odometry>("/odom");
  EXPECT_EQ(after.pose.pose, before.pose.pose);
  EXPECT_NEAR(after.pose.covariance[0], before.pose.covariance[0], 1e-9);
}

TEST_F(Parameters, OfTheRobotAreListedAsSoonAsItIsThereAndThoseOfTheNodeBefore) {
  RobotOnRos late;
  late.cable.pull();
  late.run_ms(1000);
  EXPECT_EQ(late.ros.parameters->descriptors().size(), 8);
  EXPECT_EQ(late.ros.parameters->value("publish_rate").value().double_value, 50);
  late.cable.plug_in();
  EXPECT_TRUE(late.run_until([&] { return late.ros.parameters->descriptors().size() > 40; }, 500));
}

TEST_F(Parameters, WithoutARobotOnlyThoseOfTheNodeAreThere) {
  bench.cable.pull();
  bench.run_ms(100);
  EXPECT_EQ(table().descriptors().size(), 8);
  EXPECT_FALSE(table().value("c_R"));
  EXPECT_FALSE(set({{"c_R", to_parameter(1.0)}}).successful);
}

}  // namespace
}  // namespace astro::live
