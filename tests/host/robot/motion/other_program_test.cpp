#include "host/robot/motion/other_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/links/fake_link.hpp"
#include "tests/support/links/relay_rig.hpp"

namespace astro::robot {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace)
using std::chrono::milliseconds;
using test::FakeLink;

constexpr microseconds kNoTimeout{0}, kUsual = milliseconds(200), kLong = milliseconds(1001);

long stops(const FakeLink& link) { return std::ranges::count(link.robot.seen, Stop::kId); }

class LeftDrive : public testing::Test {
 protected:
  LeftDrive() {
    client.connect();
    client.request(Arm{});
    client.request(Velocity{200'000, 0});
  }
  FakeLink link;
  Client client{link};
};

TEST_F(LeftDrive, ThatWouldNotEndByItselfWithinASecondIsStopped) {
  EXPECT_FALSE(stop_left_drive(client, kUsual)) << "it stops by itself, or somebody drives";
  EXPECT_FALSE(stop_left_drive(client, milliseconds(1000)));
  EXPECT_EQ(stops(link), 0);
  EXPECT_TRUE(stop_left_drive(client, kLong));
  EXPECT_EQ(stops(link), 1);
  client.request(Arm{});
  client.request(Velocity{200'000, 0});
  EXPECT_TRUE(stop_left_drive(client, kNoTimeout));
  EXPECT_EQ(stops(link), 2);
}

TEST_F(LeftDrive, OfARobotThatRestsOrComesToRestIsNotStoppedAgain) {
  link.robot.never_rests = true;
  client.request(Stop{});
  ASSERT_EQ(client.request(GetStatus{}).mode, Mode::stopping);
  EXPECT_FALSE(stop_left_drive(client, kNoTimeout));
  client.request(Disarm{});
  EXPECT_FALSE(stop_left_drive(client, kNoTimeout));
  EXPECT_EQ(stops(link), 1);
}

TEST(LeftDriveAtASharedPort, IsLeftAloneWhileTheProgramThatDrivesIsThere) {
  test::RelayRig rig;
  test::RelayedProgram driver(rig, 11, "astrolabe drive line 1"), node(rig, 22, "astrolabe ros2");
  driver.client.request(Arm{});
  driver.client.request(Velocity{200'000, 0});
  EXPECT_FALSE(stop_left_drive(node.client, kNoTimeout));
  EXPECT_EQ(rig.count(Stop::kId), 0);
  driver.leave();
  EXPECT_FALSE(stop_left_drive(node.client, kNoTimeout)) << "the relay has stopped it";
  EXPECT_EQ(rig.count(Stop::kId), 1);
}

}  // namespace
}  // namespace astro::robot
