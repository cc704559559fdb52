#include "host/robot/motion/rest.hpp"

#include <gtest/gtest.h>

#include "tests/support/links/fake_link.hpp"

namespace astro::robot {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace)
using test::FakeLink;

class Rest : public testing::Test {
 protected:
  Rest() {
    client.connect();
    client.request(Arm{});
    client.request(Velocity{200'000, 0});
  }
  double seconds_waited() {
    const microseconds start = client.now();
    rested = wait_until_power_off(client);
    return static_cast<double>((client.now() - start).count()) / 1e6;
  }
  void add(const char* name, std::int32_t micro) {
    test::FakeParameter parameter;
    parameter.info.id = parameter.value.id = static_cast<std::uint16_t>(900 + link.robot.parameters.size());
    parameter.info.name = Text<24>(name);
    parameter.info.kind = ParameterKind::decimal_scaled;
    parameter.info.scale_exponent = -6;
    parameter.value.active = micro;
    link.robot.parameters.push_back(parameter);
    link.robot.identity.parameter_count = static_cast<std::uint16_t>(link.robot.parameters.size());
    client.connect();
  }

  FakeLink link;
  Client client{link};
  bool rested = false;
};

TEST_F(Rest, IsReportedOnceTheRobotRests) {
  client.request(Stop{});
  EXPECT_LT(seconds_waited(), 0.1);
  EXPECT_TRUE(rested);
  EXPECT_EQ(link.robot.mode, Mode::idle);
}

TEST_F(Rest, OfARobotThatDoesNotObeyIsMadeByDisarmingItAfterFiveSeconds) {
  link.robot.never_rests = true;
  client.request(Stop{});
  EXPECT_NEAR(seconds_waited(), 5, 0.2) << "asked every 50 ms";
  EXPECT_FALSE(rested);
  EXPECT_EQ(link.robot.mode, Mode::disarmed);
}

TEST_F(Rest, DoesNotKeepAnEmergencyStopWaiting) {
  link.robot.never_rests = true;
  client.request(Stop{});
  const microseconds start = client.now();
  EXPECT_TRUE(wait_until_power_off(client, [&] { client.request(EmergencyStop{}); }));
  EXPECT_LT(client.now() - start, std::chrono::milliseconds(100));
  EXPECT_EQ(link.robot.mode, Mode::fault);
}

TEST_F(Rest, IsWaitedForAsLongAsTheRobotsOwnLimitsLetARampTake) {
  add("speed_limit", 1'000'000);
  add("acceleration_limit", 50'000);  // 20 s from 1 m/s
  link.robot.never_rests = true;
  client.request(Stop{});
  EXPECT_NEAR(seconds_waited(), 20 + 3, 0.2) << "and three for jerk, wheels and link";
  EXPECT_FALSE(rested);
  EXPECT_EQ(link.robot.mode, Mode::disarmed);
}

}  // namespace
}  // namespace astro::robot
