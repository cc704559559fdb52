#include <gmock/gmock.h>

#include "host/robot/client/client.hpp"
#include "host/robot/client/robot_problem.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/links/fake_link.hpp"

namespace astro::robot {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace)
using test::FakeLink;
using test::FakeRobot;
using test::Fate;

class Request : public testing::Test {
 protected:
  FakeLink link;
  Client client{link};

  void SetUp() override {
    client.connect();
    client.request(Arm{});
  }

  /// The first frame of this kind and direction is treated like this.
  void once(bool to_robot, std::uint8_t message_id, Fate fate) {
    link.fate = [=, met = false](bool direction, std::uint8_t id) mutable {
      const bool hit = !met && direction == to_robot && id == message_id;
      met = met || hit;
      return hit ? fate : Fate::arrives;
    };
  }
};

TEST_F(Request, IsAnsweredByItsOwnReply) {
  EXPECT_EQ(client.request(GetStatus{}).mode, Mode::idle);
  EXPECT_EQ(client.request(GetParameterInfo{2}).name.view(), "b");
}

TEST_F(Request, IsCarriedOutOnceWhateverHappensToOneFrame) {
  for (const bool to_robot : {true, false}) {
    for (const Fate fate : {Fate::lost, Fate::corrupted, Fate::twice}) {
      const std::size_t before = link.robot.segments.size();
      once(to_robot, to_robot ? AddSegment::kId : Ack::kId, fate);
      client.request(AddSegment{.kind = SegmentKind::line, .length_nm = 1});
      EXPECT_EQ(link.robot.segments.size(), before + 1) << to_robot << static_cast<int>(fate);
      EXPECT_EQ(client.request(GetParameterInfo{2}).name.view(), "b") << "the next reply is not mistaken";
      client.request(Rest{});
    }
  }
  EXPECT_EQ(client.counts().repeats, 4U) << "lost and corrupted, each way";
  EXPECT_GE(client.counts().stale_replies, 2U) << "the second replies";
}

TEST_F(Request, RepeatsACommitWithoutCommittingTwice) {
  client.request(RevertParameters{});
  once(false, Ack::kId, Fate::lost);
  client.request(CommitParameters{});
  EXPECT_EQ(link.robot.executed[CommitParameters::kId], 1);
  EXPECT_EQ(std::count(link.robot.seen.begin(), link.robot.seen.end(), CommitParameters::kId), 2);
}

TEST_F(Request, IdsNeverLookLikeAnOnlookers) {
  for (int i = 0; i < 0x8010; ++i) client.request(Ping{});
  EXPECT_EQ(link.robot.greatest_request_id, 0x7FFF);
  EXPECT_EQ(client.counts().repeats, 0U);
}

TEST_F(Request, WorksOverALineThatSpoilsEveryThirdFrame) {
  int frame = 0;
  link.fate = [&](bool, std::uint8_t) { return ++frame % 3 == 0 ? Fate::corrupted : Fate::arrives; };
  for (int i = 0; i < 100; ++i) {
    client.request(Rest{});
    client.request(AddSegment{.kind = SegmentKind::line, .tag = static_cast<std::uint16_t>(i)});
  }
  ASSERT_EQ(link.robot.segments.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(link.robot.segments[static_cast<std::size_t>(i)].tag, i);
}

TEST_F(Request, ThatIsNeverAnsweredEndsWithLinkLostAfterItsPatience) {
  link.fate = [](bool to_robot, std::uint8_t) { return to_robot ? Fate::lost : Fate::arrives; };
  const auto start = client.now();
  EXPECT_THROW(client.request(GetStatus{}, {std::chrono::milliseconds(100), 3}), LinkLost);
  EXPECT_EQ(client.now() - start, std::chrono::milliseconds(300));
}

TEST_F(Request, GivesUpOnARobotThatRestartedRatherThanRepeatIt) {
  link.fate = [&](bool to_robot, std::uint8_t id) {
    if (!to_robot || id != AddSegment::kId) return Fate::arrives;
    link.robot.restart();
    return Fate::lost;
  };
  EXPECT_THROW(client.request(AddSegment{}), LinkLost);
  EXPECT_EQ(std::count(link.robot.seen.begin(), link.robot.seen.end(), AddSegment::kId), 0);
}

TEST_F(Request, RefusalCarriesCodeDetailAndWhatWasRefused) {
  try {
    client.request(GetParameter{999});
    FAIL();
  } catch (const RobotRefused& refused) {
    EXPECT_EQ(refused.code(), ErrorCode::unknown_parameter);
    EXPECT_THAT(refused.remark(), support::Tells(RobotProblem::refused, "GetParameter"));
  }
  link.robot.raise(Fault::under_voltage);
  try {
    client.request(Arm{});
    FAIL();
  } catch (const RobotRefused& refused) {
    EXPECT_EQ(refused.detail(), static_cast<std::uint16_t>(Fault::under_voltage));
    EXPECT_THAT(refused.remark(), support::Tells(RobotProblem::faulted, "under_voltage"));
  }
}

TEST_F(Request, EventsReachTheirListenersWhileItWaits) {
  std::vector<std::uint16_t> tags;
  const auto subscription =
      client.on<SegmentDone>([&](const SegmentDone& done) { tags.push_back(done.tag); });
  client.request(AddSegment{.kind = SegmentKind::spin, .tag = 77});
  client.request(Stop{});
  client.request(GetStatus{});
  EXPECT_THAT(tags, testing::ElementsAre(77));
}

TEST_F(Request, SubscriptionEndsWithItsHandle) {
  int first = 0, second = 0;
  auto one = client.on<Telemetry>([&](const auto&) { ++first; });
  const auto two = client.on<Telemetry>([&](const auto&) { ++second; });
  client.request(SetTelemetry{10, 0});
  client.pump(std::chrono::milliseconds(100));
  one.reset();
  const int before = first;
  client.pump(std::chrono::milliseconds(100));
  EXPECT_EQ(first, before);
  EXPECT_GE(before, 9);  // one per 10 ms
  EXPECT_GE(second, before + 9);
}

TEST_F(Request, ExceptionOfAListenerLosesNoMessage) {
  int calls = 0;
  const auto subscription = client.on<SegmentDone>([&](const auto&) {
    if (++calls == 1) throw Error("from the listener");
  });
  for (int i = 0; i < 5; ++i) link.robot.event(SegmentDone{});
  EXPECT_THROW(client.pump(std::chrono::milliseconds(5)), Error);
  client.pump(std::chrono::milliseconds(5));
  EXPECT_EQ(calls, 5);
}

TEST_F(Request, PumpUntilEndsAtTheVeryMessageThatFulfilsIt) {
  client.request(SetTelemetry{1, 0});
  int seen = 0;
  const auto subscription = client.on<Telemetry>([&](const auto&) { ++seen; });
  EXPECT_TRUE(client.pump_until([&] { return seen == 7; }, std::chrono::seconds(1)));
  EXPECT_EQ(seen, 7);
  EXPECT_FALSE(client.pump_until([&] { return seen == 7000; }, std::chrono::milliseconds(20)));
}

}  // namespace
}  // namespace astro::robot
