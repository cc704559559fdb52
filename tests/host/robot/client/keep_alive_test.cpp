#include <gmock/gmock.h>

#include "host/robot/client/client.hpp"
#include "tests/support/links/fake_link.hpp"

namespace astro::robot {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace)
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::FakeLink;
using test::Fate;

class KeepAlive : public testing::Test {
 protected:
  FakeLink link;
  Client client{link};

  void SetUp() override {
    client.connect();
    client.request(Arm{});
  }
};

TEST_F(KeepAlive, PingsTwentyTimesASecondOfOurClock) {
  client.pump(seconds(10));
  EXPECT_NEAR(static_cast<double>(client.counts().pings), 200,
              10);  // 50 ms and up to one tick of 1 ms to read
}

TEST_F(KeepAlive, CountsTheEventsThatTheRobotSaysItDropped) {
  link.robot.event(EventsMissed{3});
  link.robot.event(EventsMissed{4});
  client.pump(milliseconds(10));
  EXPECT_EQ(client.counts().missed_events, 7U);
}

TEST_F(KeepAlive, KeepsAMovingRobotGoingWhosePumpRuns) {
  client.request(Velocity{100, 0});
  client.pump(seconds(5));
  EXPECT_EQ(link.robot.mode, Mode::velocity);
}

TEST_F(KeepAlive, LeavesARobotAloneThatNobodyPumps) {
  client.request(Velocity{100, 0});
  std::array<std::uint8_t, 64> nowhere;
  for (int i = 0; i < 300; ++i) link.read(nowhere, milliseconds(1));
  EXPECT_EQ(link.robot.latched, bit(Fault::link_lost));
}

TEST_F(KeepAlive, FollowsTheClockOfASimulatorInFastMotion) {
  link.rate = 300;
  link.waits_after_us = 100'000;
  client.request(SetTelemetry{10, 0});
  client.request(Velocity{100, 0});
  const std::uint64_t start = link.robot.device_us;
  const auto began = client.now();
  ASSERT_TRUE(client.pump_until([&] { return link.robot.device_us - start > 30'000'000; }, seconds(30)));
  EXPECT_EQ(link.robot.mode, Mode::velocity);
  // 30 s at 300 times real time are 0.1 s; pings every 50 ms of our clock alone would need 15 s.
  EXPECT_LT(client.now() - began, milliseconds(200));
}

TEST_F(KeepAlive, HasAtMostOnePingUnderWay) {
  link.rate = 300;
  client.request(SetTelemetry{1, 0});
  int under_way = 0, most = 0;
  link.fate = [&](bool to_robot, std::uint8_t id) {
    if (to_robot && id == Ping::kId) most = std::max(most, ++under_way);
    if (!to_robot && id == Pong::kId) --under_way;
    return Fate::arrives;
  };
  client.pump(milliseconds(100));
  EXPECT_EQ(most, 1);
}

TEST_F(KeepAlive, SurvivesSingleLostPings) {
  int pings = 0;
  link.fate = [&](bool to_robot, std::uint8_t id) {
    return to_robot && id == Ping::kId && ++pings % 2 == 0 ? Fate::lost : Fate::arrives;
  };
  client.pump(seconds(5));
  EXPECT_GT(client.counts().lost_pings, 5U);
}

TEST_F(KeepAlive, TwoLostFramesInARowDoNotStopAMovingRobot) {
  int pings = 0;
  link.fate = [&](bool to_robot, std::uint8_t id) {
    return to_robot && id == Ping::kId && ++pings % 3 != 0 ? Fate::lost : Fate::arrives;
  };
  client.request(Velocity{100, 0});
  client.pump(seconds(5));
  EXPECT_EQ(link.robot.mode, Mode::velocity);
}

TEST_F(KeepAlive, TakesPongsThatComeLateForASignOfLife) {
  link.delay = milliseconds(80);  // longer than we wait for one
  EXPECT_NO_THROW(client.pump(seconds(5)));
  EXPECT_GT(client.counts().stale_replies, 20U);
}

TEST_F(KeepAlive, ReportsARobotThatHasFallenSilentWithinTwoSeconds) {
  link.fate = [](bool to_robot, std::uint8_t) { return to_robot ? Fate::arrives : Fate::lost; };
  const auto start = client.now();
  EXPECT_THROW(client.pump(seconds(30)), LinkLost);
  EXPECT_LT(client.now() - start, seconds(2));
}

TEST_F(KeepAlive, ReportsARobotThatSendsButNoLongerHears) {
  client.request(SetTelemetry{10, 0});
  link.fate = [](bool to_robot, std::uint8_t) { return to_robot ? Fate::lost : Fate::arrives; };
  EXPECT_THROW(client.pump(seconds(30)), LinkLost);
}

TEST_F(KeepAlive, RequestsThatFlowDoNotKeepTheRobotsClockFromBeingMapped) {
  for (int i = 0; i < 500; ++i) {
    client.request(Velocity{100, 0});
    client.pump(milliseconds(20));
  }
  EXPECT_GE(client.counts().pings, 45U);  // every 200 ms
  const auto mapped = client.clock().to_host(link.robot.device_us);
  ASSERT_TRUE(mapped);
  EXPECT_LT(mapped->bound_us, 20'000);  // a round trip, and what an unknown drift makes of 200 ms
}

TEST_F(KeepAlive, MapsTheRobotsClockOnTheWay) {
  client.pump(seconds(5));
  const auto mapped = client.clock().to_host(link.robot.device_us);
  ASSERT_TRUE(mapped);
  EXPECT_LE(std::abs(static_cast<double>(mapped->us - client.now().count())), mapped->bound_us);
}

}  // namespace
}  // namespace astro::robot
