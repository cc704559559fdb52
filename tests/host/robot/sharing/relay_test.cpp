#include "host/robot/sharing/relay.hpp"

#include <gmock/gmock.h>

#include <array>
#include <memory>
#include <utility>

#include "host/robot/client/handshake.hpp"
#include "host/robot/client/robot_problem.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/drive_problem.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/robot/parameters/upload.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/links/relay_rig.hpp"

namespace astro::robot {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace)
using std::chrono::milliseconds;
using std::chrono::seconds;
using support::ThrowsTelling;
using test::RelayedProgram;
using test::RelayRig;

constexpr bool is_onlookers(const Header& header) { return (header.request_id & 0x8000) != 0; }

/// Why the request was refused: the code, or its number if this version has no name for it.
template <Request M>
std::string refusal_of(Client& client, const M& request) {
  try {
    client.request(request);
  } catch (const RobotRefused& refused) {
    return std::string(name(refused.code()));
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

/// Answers the frames that wait for the line, on request.
class FakeRobotAt {
 public:
  explicit FakeRobotAt(Relay& relay) : relay_(relay) {}
  void answer(microseconds now) {
    while (!relay_.to_robot().empty()) {
      const auto bytes = relay_.to_robot().front();
      const std::vector<std::uint8_t> frame(bytes.begin(), bytes.end());
      relay_.to_robot().taken(frame.size());
      for (const auto& reply : robot_.receive(frame)) relay_.from_robot(reply, now);
    }
  }

 private:
  Relay& relay_;
  test::FakeRobot robot_;
};

class SharedPort : public testing::Test {
 protected:
  RelayRig rig;
  RelayedProgram first{rig, 11, "astrolabe drive line 1"};
  RelayedProgram second{rig, 22, "astrolabe stop"};
};

TEST_F(SharedPort, AnswersReturnOnlyToTheProgramThatAsked) {
  first.client.request(GetStatus{});
  second.client.request(GetStatus{});
  EXPECT_EQ(second.client.request(GetParameterInfo{2}).name.view(), "b");
  EXPECT_EQ(first.client.request(GetParameterInfo{0}).name.view(), "c_R");
  EXPECT_EQ(first.client.counts().stale_replies, 0U);
  EXPECT_EQ(second.client.counts().stale_replies, 0U);
}

TEST_F(SharedPort, OnlyTheFirstHelloComesToTheRobot) {
  EXPECT_EQ(rig.count(Hello::kId), 1);
  EXPECT_FALSE(is_onlookers(rig.at_robot.front())) << "it ends what a program before left behind";
  EXPECT_EQ(second.client.robot(), first.client.robot());
  second.client.connect();
  EXPECT_EQ(rig.count(Hello::kId), 1);
}

TEST_F(SharedPort, AfterACommitTheNextHelloHearsTheNewName) {
  const UploadReport done = upload(first.client, {{"robot_name", std::string("other")}});
  EXPECT_EQ(done.active, ActiveSet::new_set);
  second.client.connect();
  EXPECT_EQ(rig.count(Hello::kId), 2);
}

TEST_F(SharedPort, AProgramOfAnotherProtocolVersionIsToldTheRobots) {
  try {
    second.client.request(Hello{static_cast<std::uint16_t>(kProtocolVersion + 1)});
    FAIL();
  } catch (const RobotRefused& refused) {
    EXPECT_EQ(refused.code(), ErrorCode::wrong_version);
    EXPECT_EQ(refused.detail(), kProtocolVersion);
  }
  EXPECT_EQ(rig.count(Hello::kId), 1);
}

TEST_F(SharedPort, OnlyTheDriversRequestsHaveBit15Clear) {
  first.client.request(Arm{});
  EXPECT_FALSE(is_onlookers(rig.at_robot.back()));
  second.client.request(GetStatus{});
  EXPECT_TRUE(is_onlookers(rig.at_robot.back()));
  second.client.request(Ping{});
  EXPECT_TRUE(is_onlookers(rig.at_robot.back()));
  first.client.request(Ping{});
  EXPECT_FALSE(is_onlookers(rig.at_robot.back()));
  first.client.request(Disarm{});
  first.client.request(GetStatus{});
  EXPECT_TRUE(is_onlookers(rig.at_robot.back())) << "nobody drives any more";
}

TEST_F(SharedPort, TheDriverKeepsPriority) {
  first.client.request(Arm{});
  EXPECT_EQ(refusal_of(second.client, Arm{}), "busy");
  EXPECT_EQ(refusal_of(second.client, Velocity{100, 0}), "busy");
  EXPECT_EQ(refusal_of(second.client, WheelVoltage{100, 0}), "busy");
  EXPECT_EQ(refusal_of(second.client, AddSegment{}), "busy");
  EXPECT_EQ(rig.count(Velocity::kId) + rig.count(AddSegment::kId), 0);
  EXPECT_EQ(rig.relay.driver(), first.id());
  EXPECT_EQ(refusal_of(first.client, Velocity{100, 0}), "taken");
}

TEST_F(SharedPort, WhoIsRefusedByTheRobotDoesNotBecomeTheDriver) {
  EXPECT_EQ(refusal_of(first.client, Velocity{100, 0}), "not_armed");
  EXPECT_EQ(rig.relay.driver(), std::nullopt);
  EXPECT_EQ(refusal_of(second.client, Arm{}), "taken");
  EXPECT_EQ(rig.relay.driver(), second.id());
}

TEST_F(SharedPort, ADriverThatGoesMakesRoomForTheNext) {
  first.client.request(Arm{});
  first.leave();
  EXPECT_EQ(refusal_of(second.client, Arm{}), "taken");
}

TEST_F(SharedPort, ASecondDriveIsRefusedWithASentenceThatNamesTheFirst) {
  first.client.request(Arm{});
  first.client.request(Velocity{100'000, 0});
  EXPECT_THAT([&] { const DriveSession session(second.client); },
              ThrowsTelling(DriveProblem::driven_by_another, "11", "astrolabe drive line 1"));
}

TEST_F(SharedPort, AStopOfAnotherEndsADriveAndSaysWhoseItWas) {
  DriveSession session(first.client);
  int passes = 0;
  rig.arrives = [&](bool to_robot, const Header& header) {
    if (to_robot && header.message_id == AddSegment::kId && ++passes == 2) second.send(Stop{}, 900);
    return true;
  };
  EXPECT_THAT([&] { session.run(square(1, Sense::cw, {})); },
              ThrowsTelling(DriveProblem::ended_early, "stopped", "22", "astrolabe stop"));
}

TEST_F(SharedPort, WhatAnotherStoppedDoesNotMoveAgainByTheNextVelocity) {
  first.client.request(Arm{});
  first.client.request(Velocity{100'000, 0});
  second.client.request(Stop{});
  EXPECT_EQ(rig.robot.mode, Mode::idle);
  EXPECT_EQ(refusal_of(first.client, Velocity{100'000, 0}), "not_armed");
  EXPECT_EQ(refusal_of(first.client, AddSegment{}), "not_armed");
  EXPECT_EQ(refusal_of(first.client, Resume{}), "not_armed");
  EXPECT_EQ(rig.robot.mode, Mode::idle);
  EXPECT_EQ(refusal_of(first.client, Arm{}), "taken") << "whoever arms it again means it";
  EXPECT_EQ(refusal_of(first.client, Velocity{100'000, 0}), "taken");
}

/// The robot receives everything, but its answers are lost.
auto deaf_line() {
  return [](bool to_robot, const Header&) { return to_robot; };
}
auto good_line() {
  return [](bool, const Header&) { return true; };
}

TEST_F(SharedPort, AStopBetweenTwoDrivesOfAProgramKeepsItFromTheSecond) {
  DriveSession(first.client).end();
  second.client.request(Stop{});
  const auto armed_before = rig.count(Arm::kId);
  EXPECT_THAT([&] { const DriveSession session(first.client); },
              ThrowsTelling(DriveProblem::stopped_by_another, "22", "astrolabe stop"));
  EXPECT_EQ(rig.count(Arm::kId), armed_before);
  RelayedProgram fresh(rig, 33, "astrolabe drive line 1");
  EXPECT_NO_THROW(DriveSession(fresh.client).end()) << "whoever begins now means it";
}

TEST_F(SharedPort, TheStatusCountsTheStopsOfAllOthersAtThisPortAndAtAnother) {
  const auto told = [](Client& client) { return client.request(GetStatus{}).stops_by_others; };
  const int to_first = told(first.client), to_second = told(second.client);
  second.client.request(Stop{});
  EXPECT_EQ(told(first.client), to_first + 1);
  EXPECT_EQ(told(second.client), to_second) << "it has done so itself";
  ++rig.robot.stops_by_others;
  EXPECT_EQ(told(first.client), to_first + 2);
  EXPECT_EQ(told(second.client), to_second + 1);
  first.client.connect();
  EXPECT_EQ(told(first.client), to_first + 2) << "it goes on counting";
}

// Between the status and the Arm of a program that drives several times.
TEST_F(SharedPort, AnArmOfAProgramThatCannotKnowOfAStopIsRefused) {
  first.client.request(GetStatus{});
  second.client.request(Stop{});
  EXPECT_EQ(refusal_of(first.client, Arm{}), "not_armed");
  first.client.request(GetStatus{});
  EXPECT_EQ(refusal_of(first.client, Arm{}), "taken");
  first.client.request(Disarm{});
  first.client.request(GetStatus{});
  ++rig.robot.stops_by_others;
  second.client.request(GetStatus{});  // by which the robot has told this port
  EXPECT_EQ(refusal_of(first.client, Arm{}), "not_armed");
}

TEST_F(SharedPort, TheRobotIsStoppedForADriverThatIsKilled) {
  first.client.request(Arm{});
  first.client.request(Velocity{100'000, 0});
  first.leave();
  rig.run(milliseconds(1));
  EXPECT_EQ(rig.count(Stop::kId), 1);
  EXPECT_FALSE(is_onlookers(rig.at_robot.back())) << "to the robot its driver has stopped it";
  rig.run(milliseconds(500));
  EXPECT_EQ(rig.count(Stop::kId), 1) << "it is answered";
  EXPECT_EQ(rig.robot.mode, Mode::idle);
}

/// Stops do not reach the robot.
auto stopless_line() {
  return [](bool to_robot, const Header& header) { return !to_robot || header.message_id != Stop::kId; };
}

TEST_F(SharedPort, TheStopForADriverThatIsGoneIsRepeatedUntilTheRobotAnswers) {
  first.client.request(Arm{});
  first.client.request(Velocity{100'000, 0});
  rig.arrives = stopless_line();
  first.leave();
  rig.run(milliseconds(100));
  ASSERT_EQ(rig.robot.mode, Mode::velocity);
  EXPECT_TRUE(rig.relay.owes_stop());
  rig.arrives = good_line();
  rig.run(milliseconds(100));
  EXPECT_EQ(rig.robot.mode, Mode::idle);
  EXPECT_EQ(rig.count(Stop::kId), 1);
  EXPECT_FALSE(rig.relay.owes_stop());
}

// It would take the drive over, or be stopped in place of the one that has gone.
TEST_F(SharedPort, NobodyArmsBeforeTheRobotHasStoppedForADriverThatIsGone) {
  first.client.request(Arm{});
  first.client.request(Velocity{100'000, 0});
  rig.arrives = stopless_line();
  first.leave();
  second.send(Arm{}, 500);
  rig.run(milliseconds(50));
  EXPECT_EQ(rig.count(Arm::kId), 1) << "that of the first";
  rig.arrives = good_line();
  rig.run(milliseconds(100));
  second.send(Arm{}, 500);  // as a client does after 60 ms
  rig.run(milliseconds(100));
  EXPECT_EQ(rig.count(Arm::kId), 2);
  EXPECT_EQ(rig.count(Stop::kId), 1);
  EXPECT_EQ(refusal_of(second.client, Velocity{100, 0}), "taken");
}

// The robot's name may have changed, so it is asked again; but a Hello of the port's owner would end what it knows of the port.
TEST_F(SharedPort, AfterACommitAProgramThatComesIsAnOnlookerToTheRobot) {
  first.client.request(RevertParameters{});
  first.client.request(CommitParameters{});
  const auto hellos = rig.count(Hello::kId);
  RelayedProgram next(rig, 33, "astrolabe info");
  EXPECT_EQ(rig.count(Hello::kId), hellos + 1);
  EXPECT_TRUE(
      is_onlookers(*std::find_if(rig.at_robot.rbegin(), rig.at_robot.rend(),
                                 [](const Header& header) { return header.message_id == Hello::kId; })));
}

TEST_F(SharedPort, AProgramThatEndsItsOwnDriveStopsNobodyElse) {
  DriveSession(first.client).end();
  DriveSession(second.client).end();
  EXPECT_NO_THROW(DriveSession(first.client).end());
}

TEST_F(SharedPort, ADriverThatHasStoppedOrNeverDroveLeavesQuietly) {
  DriveSession(first.client).end();
  const auto stops = rig.count(Stop::kId);
  first.leave();
  second.leave();
  rig.run(milliseconds(200));
  EXPECT_EQ(rig.count(Stop::kId), stops);
}

TEST_F(SharedPort, ARepeatedVelocityDoesNotOvertakeAStop) {
  first.client.request(Arm{});
  rig.arrives = [](bool to_robot, const Header& header) { return to_robot || header.message_id != Ack::kId; };
  first.send(Velocity{100'000, 0}, 700);
  EXPECT_EQ(rig.robot.mode, Mode::velocity);
  second.send(Stop{}, 900);
  EXPECT_EQ(rig.robot.mode, Mode::idle);
  first.send(Velocity{100'000, 0}, 700);  // its Ack was lost
  EXPECT_EQ(rig.robot.mode, Mode::idle);
}

TEST_F(SharedPort, AfterItsOwnRestADriverGoesOnAndAfterItsOwnStopItArmsAgain) {
  first.client.request(Arm{});
  first.client.request(Rest{});
  EXPECT_EQ(refusal_of(first.client, Velocity{100, 0}), "taken");
  first.client.request(Stop{});
  EXPECT_EQ(refusal_of(first.client, Velocity{100, 0}), "not_armed");
  first.client.request(Arm{});
  EXPECT_EQ(refusal_of(first.client, Velocity{100, 0}), "taken");
}

TEST_F(SharedPort, OfOnlookersOneRequestIsUnderWayAtATime) {
  rig.arrives = deaf_line();
  second.send(GetStatus{}, 800);
  first.send(GetFaults{}, 801);
  first.send(GetFaults{}, 801);  // and again, because it is not answered
  EXPECT_EQ(rig.count(GetStatus::kId), 1);
  EXPECT_EQ(rig.count(GetFaults::kId), 0) << "the robot remembers one answer of onlookers";
  rig.arrives = good_line();
  second.send(GetStatus{}, 800);
  EXPECT_EQ(rig.count(GetStatus::kId), 2);
  EXPECT_EQ(rig.count(GetFaults::kId), 1) << "its turn, once";
}

TEST_F(SharedPort, AProgramThatDiesWithItsRequestUnderWayHoldsUpNobody) {
  rig.arrives = deaf_line();
  second.send(GetStatus{}, 800);
  rig.arrives = good_line();
  second.leave();
  first.send(GetFaults{}, 801);
  EXPECT_EQ(rig.count(GetFaults::kId), 1);
}

TEST_F(SharedPort, ARequestThatIsNeverAnsweredHoldsUpTheOthersForASecond) {
  rig.arrives = deaf_line();
  second.send(GetStatus{}, 800);
  first.send(GetFaults{}, 801);
  rig.run(milliseconds(999));
  EXPECT_EQ(rig.count(GetFaults::kId), 0);
  rig.run(milliseconds(2));  // a Client gives up a request after 16 tries of 60 ms
  EXPECT_EQ(rig.count(GetFaults::kId), 1);
}

TEST_F(SharedPort, AnEmergencyStopWaitsForNobody) {
  rig.arrives = deaf_line();
  first.send(CommitParameters{}, 801);  // may take seconds
  second.send(EmergencyStop{}, 800);
  EXPECT_EQ(rig.count(EmergencyStop::kId), 1);
  EXPECT_TRUE(is_onlookers(rig.at_robot.back()));
}

TEST_F(SharedPort, APauseOfAnOnlookerWaitsForNobody) {
  rig.arrives = deaf_line();
  first.send(CommitParameters{}, 801);  // may take seconds
  second.send(Pause{}, 800);
  EXPECT_EQ(rig.count(Pause::kId), 1);
  EXPECT_TRUE(is_onlookers(rig.at_robot.back()));
  first.send(CommitParameters{}, 801);
  EXPECT_EQ(rig.count(CommitParameters::kId), 2) << "its turn has not ended";
}

/// The requests that wait for the line, in their order; the line takes them.
std::vector<std::uint8_t> taken_from(Relay& relay) {
  protocol::Framer framer;
  std::vector<std::uint8_t> order;
  while (!relay.to_robot().empty()) {
    for (const std::uint8_t byte : relay.to_robot().front())
      if (const auto body = framer.push(byte)) order.push_back(body->front());
    relay.to_robot().taken(relay.to_robot().front().size());
  }
  return order;
}

TEST_F(SharedPort, AnEmergencyStopOvertakesWhatWaitsForTheLine) {
  Relay relay;
  const SessionId one = relay.join({11, "one"}), two = relay.join({22, "two"});
  relay.from_session(one, Frame(Arm{}, 1).bytes(), rig.now);
  relay.from_session(one, Frame(Ping{}, 2).bytes(), rig.now);
  relay.to_robot().taken(3);  // 3 bytes of the first frame are written
  relay.from_session(two, Frame(EmergencyStop{}, 1).bytes(), rig.now);
  // The rest of the Arm is not a frame of its own.
  EXPECT_THAT(taken_from(relay), testing::ElementsAre(EmergencyStop::kId, Ping::kId));
}

TEST_F(SharedPort, WhatWasToMoveTheRobotAndHasNotGoneToItWhenAStopComesGoesNoMore) {
  for (const bool by_another : {false, true})
    for (const auto& motion : {Frame(Velocity{100'000, 0}, 2), Frame(line(1, {}).front(), 2),
                               Frame(Resume{}, 2), Frame(Arm{}, 2)}) {
      Relay relay;
      FakeRobotAt robot(relay);
      const SessionId driver = relay.join({11, "drive"}), other = relay.join({22, "stop"});
      relay.from_session(driver, Frame(Arm{}, 1).bytes(), rig.now);
      robot.answer(rig.now);
      relay.from_session(driver, motion.bytes(), rig.now);
      relay.from_session(driver, Frame(Ping{}, 3).bytes(), rig.now);
      relay.from_session(by_another ? other : driver, Frame(Stop{}, 4).bytes(), rig.now);
      EXPECT_THAT(taken_from(relay), testing::ElementsAre(Stop::kId, Ping::kId)) << by_another;
    }
}

TEST(Relay, APauseKeepsItsPlaceOnTheLineSoThatItComesAfterWhatWasSentBeforeIt) {
  Relay relay;
  FakeRobotAt robot(relay);
  const SessionId driver = relay.join({11, "drive"}), other = relay.join({22, "pause"});
  relay.from_session(driver, Frame(Arm{}, 1).bytes(), milliseconds(0));
  robot.answer(milliseconds(0));
  relay.from_session(driver, Frame(Ping{}, 2).bytes(), milliseconds(0));
  relay.from_session(other, Frame(Pause{}, 1).bytes(), milliseconds(0));
  relay.from_session(driver, Frame(line(1, {}).front(), 3).bytes(), milliseconds(0));
  EXPECT_THAT(taken_from(relay), testing::ElementsAre(Ping::kId, Pause::kId, AddSegment::kId));
}

/// Requests after which a Resume that was sent before must not move the robot.
std::vector<Frame> requests_to_halt(std::uint16_t id) {
  return {Frame(Stop{}, id), Frame(EmergencyStop{}, id), Frame(Disarm{}, id), Frame(Pause{}, id)};
}

TEST(Relay, AResumeThatWaitsItsTurnGoesNoMoreOnceSomebodyHaltsTheRobot) {
  for (const Frame& halt : requests_to_halt(1)) {
    Relay relay;
    FakeRobotAt robot(relay);
    const SessionId asks = relay.join({11, "info"}, false), resumes = relay.join({22, "resume"}, false),
                    halts = relay.join({33, "stop"}, false);
    relay.from_session(asks, Frame(GetStatus{}, 1).bytes(), milliseconds(0));
    relay.from_session(resumes, Frame(Resume{}, 7).bytes(), milliseconds(1));
    relay.from_session(halts, halt.bytes(), milliseconds(2));
    EXPECT_THAT(taken_from(relay), testing::Not(testing::Contains(Resume::kId)));
    relay.from_session(resumes, Frame(Resume{}, 7).bytes(), milliseconds(61));  // its program repeats it
    relay.tick(seconds(2));  // the turn of the first has ended
    EXPECT_THAT(taken_from(relay), testing::Not(testing::Contains(Resume::kId)));
    EXPECT_FALSE(relay.to_session(resumes).empty()) << "its program is told";
    relay.from_session(resumes, Frame(Resume{}, 8).bytes(), seconds(3));
    EXPECT_THAT(taken_from(relay), testing::ElementsAre(Resume::kId)) << "one that was sent later goes";
  }
}

/// What comes to the robot when a program repeats its request because the answer was lost, and another one
/// halts the robot in between.
std::vector<std::uint8_t> repeated_after(const Frame& halt, const Frame& motion, bool needs_arm = false) {
  Relay relay;
  FakeRobotAt robot(relay);
  const SessionId moves = relay.join({22, "moves"}, false), halts = relay.join({33, "halts"}, false);
  if (needs_arm) relay.from_session(moves, Frame(Arm{}, 1).bytes(), milliseconds(0));
  robot.answer(milliseconds(0));
  relay.from_session(moves, motion.bytes(), milliseconds(0));
  taken_from(relay);
  relay.from_session(halts, halt.bytes(), milliseconds(2));
  taken_from(relay);
  relay.from_session(moves, motion.bytes(), milliseconds(60));
  return taken_from(relay);
}

TEST(Relay, ARequestForMotionThatWasSentBeforeAHaltIsNotRepeatedAfterIt) {
  for (const Frame& halt : requests_to_halt(1))
    EXPECT_THAT(repeated_after(halt, Frame(Resume{}, 7)), testing::IsEmpty());
  for (const Frame& stop : {Frame(Stop{}, 1), Frame(EmergencyStop{}, 1), Frame(Disarm{}, 1)})
    for (const Frame& motion : {Frame(Arm{}, 7), Frame(Velocity{100'000, 0}, 7)})
      EXPECT_THAT(repeated_after(stop, motion, true), testing::IsEmpty());
  EXPECT_THAT(repeated_after(Frame(Pause{}, 1), Frame(line(1, {}).front(), 7), true),
              testing::ElementsAre(AddSegment::kId))
      << "a segment waits in the paused robot";
}

TEST(Relay, TheAnswerToAnArmThatAStopOvertookDoesNotUndoTheStop) {
  Relay relay;
  const SessionId driver = relay.join({11, "drive"}, false), other = relay.join({22, "stop"}, false);
  relay.from_session(driver, Frame(Arm{}, 1).bytes(), milliseconds(0));
  const auto frame = relay.to_robot().front();
  const Header arm = RelayRig::header_of({frame.begin(), frame.end()});
  taken_from(relay);
  relay.from_session(other, Frame(Stop{}, 1).bytes(), milliseconds(1));
  taken_from(relay);
  relay.from_robot(Frame(Ack{}, arm.request_id).bytes(), milliseconds(2));
  relay.from_session(driver, Frame(Velocity{100'000, 0}, 2).bytes(), milliseconds(3));
  EXPECT_TRUE(relay.to_robot().empty()) << "the robot stays at rest until it is armed after the stop";
}

TEST(Relay, ARepeatedFirstHelloLeavesADriverAloneThatCameMeanwhile) {
  Relay relay;
  FakeRobotAt robot(relay);
  const SessionId monitor = relay.join({11, "monitor"}), driver = relay.join({22, "drive"});
  const Frame hello(Hello{}, 1);
  relay.from_session(monitor, hello.bytes(), milliseconds(0));
  taken_from(relay);  // lost on the line
  relay.from_session(driver, hello.bytes(), milliseconds(100));
  robot.answer(milliseconds(101));
  relay.from_session(driver, Frame(Arm{}, 2).bytes(), milliseconds(102));
  robot.answer(milliseconds(103));
  relay.from_session(monitor, hello.bytes(), milliseconds(300));
  EXPECT_THAT(taken_from(relay), testing::Not(testing::Contains(Hello::kId)))
      << "the robot's answer is known";
  EXPECT_FALSE(relay.to_session(monitor).empty());
}

TEST_F(SharedPort, AStopIsCarriedOutEachTimeEvenIfItsIdHasComeBefore) {
  for (const int times : {1, 2}) {
    second.send(EmergencyStop{}, 800);
    EXPECT_EQ(rig.count(EmergencyStop::kId), times) << "the program's ids have wrapped meanwhile";
  }
}

TEST_F(SharedPort, APauseIsCarriedOutEachTimeEvenIfItsIdHasComeBefore) {
  for (const int times : {1, 2}) {
    second.send(Pause{}, 800);
    EXPECT_EQ(rig.count(Pause::kId), times) << "the program's ids have wrapped meanwhile";
  }
}

TEST_F(SharedPort, ARepeatedRequestHasTheSameIdAndIsCarriedOutOnce) {
  first.client.request(Arm{});
  int lost = 2;
  rig.arrives = [&](bool to_robot, const Header& header) {
    return to_robot || header.message_id != Ack::kId || lost-- <= 0;
  };
  first.client.request(line(1, {}).front());
  EXPECT_EQ(rig.count(AddSegment::kId), 3);
  EXPECT_EQ(rig.robot.executed[AddSegment::kId], 1);
}

TEST_F(SharedPort, TheSameRequestAgainIsAnsweredFromMemoryWithoutTheRobot) {
  first.client.request(Arm{});
  first.send(Velocity{100, 0}, 700);
  first.send(Velocity{100, 0}, 700);
  EXPECT_EQ(rig.count(Velocity::kId), 1);
}

TEST_F(SharedPort, TelemetryIsForThoseWhoAskedAndAsTheyAsked) {
  int at_first = 0, at_second = 0;
  std::uint32_t fields_first = 0, fields_second = 0;
  const auto one =
      first.client.on<Telemetry>([&](const Telemetry& t) { ++at_first, fields_first = t.fields; });
  const auto two =
      second.client.on<Telemetry>([&](const Telemetry& t) { ++at_second, fields_second = t.fields; });
  first.client.request(SetTelemetry{10, Telemetry::kPose});
  rig.run(seconds(1));
  first.client.pump(milliseconds(1));
  second.client.pump(milliseconds(1));
  EXPECT_NEAR(at_first, 100, 2);
  EXPECT_EQ(at_second, 0) << "asked for none";

  at_first = 0;
  second.client.request(SetTelemetry{100, Telemetry::kBattery | Telemetry::kState});
  rig.run(seconds(1));
  first.client.pump(milliseconds(1));
  second.client.pump(milliseconds(1));
  EXPECT_NEAR(at_first, 100, 3) << "as before";
  EXPECT_EQ(fields_first, Telemetry::kPose);
  EXPECT_NEAR(at_second, 10, 1);
  EXPECT_EQ(fields_second, Telemetry::kBattery | Telemetry::kState);
}

TEST_F(SharedPort, TheRobotIsToldWhenNobodyWantsTelemetryAnyMore) {
  second.client.request(SetTelemetry{10, Telemetry::kPose});
  second.leave();
  rig.run(milliseconds(100));
  const std::uint64_t before = rig.robot.device_us;
  int came = 0;
  const auto one = first.client.on<Telemetry>([&](const Telemetry&) { ++came; });
  rig.arrives = [&](bool to_robot, const Header& header) {
    if (!to_robot && header.message_id == Telemetry::kId) ++came;
    return true;
  };
  rig.run(seconds(1));
  EXPECT_EQ(came, 0);
  EXPECT_GT(rig.robot.device_us, before);
}

TEST_F(SharedPort, ALostTelemetrySettingIsAskedForAgain) {
  int lost = 5;
  rig.arrives = [&](bool to_robot, const Header& header) {
    return !to_robot || header.message_id != SetTelemetry::kId || lost-- <= 0;
  };
  int came = 0;
  const auto one = first.client.on<Telemetry>([&](const Telemetry&) { ++came; });
  first.client.request(SetTelemetry{10, Telemetry::kPose});
  first.client.pump(seconds(1));
  EXPECT_GT(came, 50);
}

TEST(TelemetryRequest, KeepsTheMeanRateBesideAStreamOfAnyPeriod) {
  for (const std::uint16_t stream : std::array<std::uint16_t, 4>{1, 3, 7, 10}) {
    for (const std::uint16_t wanted : std::array<std::uint16_t, 4>{10, 25, 100, 333}) {
      TelemetryRequest request(SetTelemetry{wanted, Telemetry::kPose});
      int came = 0;
      constexpr std::uint64_t kEnd_us = 10'000'000;
      for (std::uint64_t at = 5'000'000; at < 5'000'000 + kEnd_us; at += std::uint64_t{1000} * stream)
        came += request.is_due(at, stream) ? 1 : 0;
      EXPECT_NEAR(came, 10'000.0 / wanted, 1.5) << stream << " ms for " << wanted << " ms";
    }
  }
}

TEST(TelemetryRequest, PassesEverySampleOfItsOwnPeriodThoughTheirTimesWaver) {
  TelemetryRequest request(SetTelemetry{10, Telemetry::kPose});
  int came = 0;
  for (std::uint64_t i = 0; i < 1000; ++i)
    came += request.is_due(1'000'000 + 10'000 * i + (i % 3 == 0 ? 1000 : 0), 10) ? 1 : 0;
  EXPECT_EQ(came, 1000);
}

TEST_F(SharedPort, EventsGoToEverybody) {
  int boots = 0;
  const auto count = [&](const FaultRaised& raised) { boots += raised.fault == Fault::stall ? 1 : 0; };
  const auto one = first.client.on<FaultRaised>(count);
  const auto two = second.client.on<FaultRaised>(count);
  rig.robot.raise(Fault::stall);
  rig.step();
  first.client.pump(milliseconds(2));
  second.client.pump(milliseconds(2));
  EXPECT_EQ(boots, 2);
}

TEST_F(SharedPort, AReaderThatIsStuckLosesTelemetryFirstAndSlowsNobody) {
  first.client.request(SetTelemetry{10, Telemetry::kAll});
  second.client.request(SetTelemetry{10, Telemetry::kAll});
  int came = 0;
  const auto one = first.client.on<Telemetry>([&](const Telemetry&) { ++came; });
  for (int i = 0; i < 60; ++i) first.client.pump(seconds(1));  // the second reads nothing
  EXPECT_NEAR(came, 6000, 70);
  EXPECT_LT(rig.relay.to_session(second.id()).bytes(), 66'000U);
  EXPECT_EQ(rig.relay.closing(second.id()), std::nullopt) << "it may only be waiting at a prompt";
  EXPECT_EQ(second.client.request(GetStatus{}).mode, Mode::disarmed) << "and goes on where it was";
}

TEST_F(SharedPort, AReaderThatLosesEventsIsLetGoWithTheReason) {
  for (int i = 0; i < 30'000; ++i) {
    rig.robot.event(SegmentDone{1, SegmentOutcome::completed, rig.robot.device_us});
    if (i % 100 == 0) rig.step(), first.client.pump(milliseconds(1));
  }
  EXPECT_EQ(rig.relay.closing(second.id()), FarewellReason::reads_too_slowly);
  EXPECT_LT(rig.relay.to_session(second.id()).bytes(), 100U);
  EXPECT_THAT([&] { second.client.pump(seconds(1)); },
              ThrowsTelling(FarewellReason::reads_too_slowly, "port0"));
  first.client.request(GetStatus{});
}

/// A relay with a program that it disconnects because it reads too slowly.
class ASlowReader : public testing::Test {
 protected:
  ASlowReader() {
    relay.from_session(driver, Frame(Arm{}, 1).bytes(), now);
    taken_from(relay);
    const Frame event(SegmentDone{1, SegmentOutcome::completed, 5'000'000}, 0);
    while (!relay.closing(slow)) {
      relay.from_robot(event.bytes(), now);
      while (!relay.to_session(driver).empty())
        relay.to_session(driver).taken(relay.to_session(driver).front().size());
    }
  }
  microseconds now = seconds(1);
  Relay relay;
  SessionId driver = relay.join({11, "drive"}), slow = relay.join({22, "slow"});
};

TEST_F(ASlowReader, IsHeardToTheEndWhenItHaltsTheRobot) {
  for (const Frame& halt : requests_to_halt(9)) {
    relay.from_session(slow, halt.bytes(), now);
    EXPECT_EQ(taken_from(relay).size(), 1U);
  }
  relay.from_session(driver, Frame(Velocity{100'000, 0}, 2).bytes(), now);
  EXPECT_TRUE(relay.to_robot().empty()) << "the driver was stopped by another program";
}

TEST_F(ASlowReader, IsHeardEvenIfItsLastRequestWasCutInTwo) {
  const Frame stop(Stop{}, 9);
  const auto bytes = stop.bytes();
  relay.from_session(slow, bytes.first(3), now);
  relay.from_session(slow, bytes.subspan(3), now);
  EXPECT_THAT(taken_from(relay), testing::ElementsAre(Stop::kId));
}

TEST_F(ASlowReader, GetsNothingElseToTheRobotAndNoReply) {
  const std::size_t waiting = relay.to_session(slow).bytes();
  for (const Frame& request :
       {Frame(GetStatus{}, 2), Frame(Resume{}, 3), Frame(Ping{}, 4), Frame(ClearFaults{}, 5),
        Frame(SetTelemetry{10, Telemetry::kPose}, 6), Frame(GetPortUsers{}, 7), Frame(Hello{}, 8)})
    relay.from_session(slow, request.bytes(), now);
  EXPECT_THAT(taken_from(relay), testing::IsEmpty());
  EXPECT_EQ(relay.to_session(slow).bytes(), waiting);
}

TEST_F(SharedPort, TwoUploadsAtOnceAreNeverMixed) {
  // The second begins to stage just before the first commits; and the other way round.
  for (const bool second_begins : {true, false}) {
    Client& mine = second_begins ? first.client : second.client;
    RelayedProgram& other = second_begins ? second : first;
    RemoteParameters parameters = RemoteParameters::fetch(mine);
    parameters.revert();
    parameters.stage("c_R", 1.01);
    other.client.request(RevertParameters{});
    RemoteParameters others = RemoteParameters::fetch(other.client);
    others.stage("c_L", 0.99);
    EXPECT_THROW(parameters.stage("b", 0.3), RobotRefused);
    EXPECT_THROW(parameters.commit(), RobotRefused);
    others.commit();
    EXPECT_EQ(std::get<double>(RemoteParameters::fetch(mine).value("c_R")), 1.0)
        << "not committed by the other";
    EXPECT_NEAR(std::get<double>(RemoteParameters::fetch(mine).value("c_L")), 0.99, 1e-8);
    EXPECT_EQ(upload(mine, {{"c_L", 1.0}}).active, ActiveSet::new_set) << "an upload of its own goes through";
  }
}

TEST_F(SharedPort, WhatIsStagedIsShownToTheProgramThatStagedIt) {
  RemoteParameters mine = RemoteParameters::fetch(first.client);
  mine.revert();
  mine.stage("c_R", 1.01);
  EXPECT_NE(RemoteParameters::fetch(first.client).row("c_R").staged, mine.row("c_R").active);
  EXPECT_EQ(RemoteParameters::fetch(second.client).row("c_R").staged, mine.row("c_R").active);
}

TEST_F(SharedPort, AProgramThatGoesLeavesNothingStagedForTheNext) {
  RemoteParameters mine = RemoteParameters::fetch(first.client);
  mine.revert();
  mine.stage("c_R", 1.01);
  first.leave();
  EXPECT_NE(refusal_of(second.client, CommitParameters{}), "taken");
}

TEST_F(SharedPort, ARestartOfTheRobotIsANewBeginningForAll) {
  first.client.request(Arm{});
  second.client.request(SetTelemetry{10, Telemetry::kPose});
  rig.robot.restart();
  rig.step();
  EXPECT_EQ(rig.relay.driver(), std::nullopt);
  second.client.pump(milliseconds(2));  // receives the event
  EXPECT_EQ(refusal_of(second.client, Arm{}), "taken");
  second.client.connect();
  EXPECT_EQ(rig.count(Hello::kId), 2) << "it may be another robot";
}

TEST_F(SharedPort, TooManyProgramsAreTurnedAwayWithTheReason) {
  std::vector<std::unique_ptr<RelayedProgram>> many;
  const auto ask_for_telemetry = [&] {
    many.push_back(std::make_unique<RelayedProgram>(rig, 1, "astrolabe monitor"));
    many.back()->send(SetTelemetry{100, Telemetry::kPose}, 900);
    return rig.relay.closing(many.back()->id());
  };
  for (int i = 0; i < 32; ++i) ASSERT_EQ(ask_for_telemetry(), std::nullopt) << i;
  EXPECT_EQ(ask_for_telemetry(), FarewellReason::too_many);
  EXPECT_EQ(rig.relay.closing(many.front()->id()), std::nullopt);
  EXPECT_EQ(second.client.request(GetStatus{}).mode, Mode::disarmed);
  many.erase(many.begin());
  EXPECT_EQ(ask_for_telemetry(), std::nullopt) << "one has gone";
}

TEST_F(SharedPort, AStopFindsAPlaceBesideProgramsThatHangAndThoseThatTakeEveryPlace) {
  first.client.request(Arm{});
  std::vector<std::unique_ptr<RelayedProgram>> monitors;
  for (int i = 0; i < 40; ++i) {
    monitors.push_back(std::make_unique<RelayedProgram>(rig, 1, "astrolabe monitor"));
    monitors.back()->send(SetTelemetry{100, Telemetry::kPose}, 900);
  }
  std::vector<SessionId> silent;
  for (int i = 0; i < 300; ++i) silent.push_back(rig.relay.join({2, "hangs"}));
  EXPECT_EQ(rig.relay.closing(silent.front()), FarewellReason::too_many) << "the longest silent goes first";
  RelayedProgram stop(rig, 3, "astrolabe stop");
  stop.client.request(Stop{});
  EXPECT_EQ(rig.count(Stop::kId), 1);
  EXPECT_EQ(rig.relay.closing(first.id()), std::nullopt) << "and whoever speaks stays";
}

TEST_F(SharedPort, GarbageFromAProgramStaysWithTheRelay) {
  const std::size_t before = rig.at_robot.size();
  std::vector<std::uint8_t> noise(10'000);
  std::uint32_t state = 12345;
  for (auto& byte : noise) byte = static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24);
  second.transport.write(noise);
  second.send(GetStatus{}, 0);  // no request has this id
  EXPECT_EQ(rig.at_robot.size(), before);
}

// ---- messages for people

TEST(Relay, ADeviceThatSendsNoFramesIsToldFromASilentOne) {
  for (const bool talks : {true, false}) {
    RelayRig line;
    line.arrives = [](bool, const Header&) { return false; };
    test::RelayedTransport transport(line, {11, "astrolabe info"}, false);
    const std::vector<std::uint8_t> text{'l', 'o', 'g', 'i', 'n', ':'};
    if (talks) line.relay.from_robot(text, line.now);
    Client client(transport);
    EXPECT_THAT(
        [&] { client.connect(); },
        ThrowsTelling(talks ? HandshakeProblem::no_frames : HandshakeProblem::nothing_comes, "port0"));
  }
}

TEST(Relay, AProgramThatRepeatsItsHelloOnANoisyLineAndDoesNotReadIsLetGoAndNotAskedForAgain) {
  Relay relay;
  const SessionId id = relay.join({11, "astrolabe info"}, false);
  const std::vector<std::uint8_t> text{'l', 'o', 'g', 'i', 'n', ':'};
  relay.from_robot(text, milliseconds(0));
  const Frame hello(Hello{}, 1);
  std::size_t most = 0;
  for (int i = 0; i < 200'000 && !relay.closing(id); ++i) {
    relay.from_session(id, hello.bytes(), milliseconds(i));  // each time it is told that the line is noisy
    most = std::max(most, relay.to_session(id).bytes());
    if (!relay.closing(id)) taken_from(relay);
  }
  EXPECT_EQ(relay.closing(id), FarewellReason::reads_too_slowly);
  EXPECT_NEAR(static_cast<double>(most), 1 << 18, 2) << "the bound of what waits for a program";
  EXPECT_TRUE(relay.to_robot().empty()) << "the Hello of a program that has been let go begins no session";
}

TEST_F(SharedPort, AFaultIsReportedAsThatFaultThoughTheAbortedSegmentArrivesFirst) {
  DriveSession session(first.client);
  rig.arrives = [&](bool to_robot, const Header&) {
    if (to_robot || rig.robot.mode != Mode::segment) return true;
    rig.robot.event(SegmentDone{1, SegmentOutcome::aborted, rig.robot.device_us});
    rig.robot.raise(Fault::stall);
    return true;
  };
  EXPECT_THAT([&] { session.run(line(1, {})); }, ThrowsTelling(RobotProblem::faulted, "stall"));
}

TEST_F(SharedPort, AnEmergencyStopOfAnotherIsNamedWithTheProgram) {
  DriveSession session(first.client);
  rig.arrives = [&, once = false](bool to_robot, const Header& header) mutable {
    if (!to_robot || header.message_id != AddSegment::kId || std::exchange(once, true)) return true;
    second.send(EmergencyStop{}, 900);
    rig.robot.raise(Fault::emergency_stop);
    return true;
  };
  EXPECT_THAT([&] { session.run(line(1, {})); },
              ThrowsTelling(RobotProblem::faulted, "emergency_stop", "22", "astrolabe stop"));
}

}  // namespace
}  // namespace astro::robot
