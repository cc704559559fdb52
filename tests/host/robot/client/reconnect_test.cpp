#include <gmock/gmock.h>

#include "host/robot/client/client.hpp"
#include "host/robot/client/handshake.hpp"
#include "host/robot/port/open_transport.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/links/fake_link.hpp"

namespace astro::robot {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace)
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::FakeLink;

class Reconnect : public testing::Test {
 protected:
  FakeLink link;
  Client client{link};
  void SetUp() override { client.connect(); }
};

TEST_F(Reconnect, FindsTheRobotAgainWhenItComesBack) {
  link.stays_away = seconds(3);
  link.drop();
  EXPECT_THROW(client.request(GetStatus{}), LinkLost);
  const auto start = client.now();
  client.reconnect(seconds(10));
  EXPECT_LT(client.now() - start, milliseconds(3100));
  EXPECT_EQ(client.request(GetStatus{}).mode, Mode::disarmed);
}

TEST_F(Reconnect, WaitsForARobotThatStillStarts) {
  const auto up_at = client.now() + seconds(4);
  link.fate = [&](bool, std::uint8_t) {
    return client.now() < up_at ? test::Fate::lost : test::Fate::arrives;
  };
  client.reconnect(seconds(10));
  EXPECT_GE(client.now(), up_at);
}

TEST_F(Reconnect, GivesUpInTimeWithTheReason) {
  link.stays_away = seconds(60);
  link.drop();
  const auto start = client.now();
  EXPECT_THAT([&] { client.reconnect(seconds(5)); },
              support::ThrowsTelling<LinkLost>(PortProblem::absent, "fake0"));
  EXPECT_EQ(client.now() - start, seconds(5));
}

TEST_F(Reconnect, DoesNotTakeAnotherRobotForTheSame) {
  link.drop();
  link.robot.identity.unique_id.fill(8);
  link.robot.identity.robot_name = "other";
  EXPECT_THAT([&] { client.reconnect(seconds(5)); },
              support::ThrowsTelling(HandshakeProblem::other_robot, "fake0", "other", "astro"));
  EXPECT_EQ(client.robot().robot_name.view(), "astro");
}

TEST_F(Reconnect, BeginsTheClockMapAnewForARobotThatRestarted) {
  client.pump(seconds(1));
  link.restarts_on_drop = true;
  link.drop();
  client.reconnect(seconds(5));
  EXPECT_FALSE(client.clock().to_host(0));
  client.pump(seconds(1));
  const auto mapped = client.clock().to_host(link.robot.device_us);
  ASSERT_TRUE(mapped);
  EXPECT_NEAR(static_cast<double>(mapped->us), static_cast<double>(client.now().count()), mapped->bound_us);
}

}  // namespace
}  // namespace astro::robot
