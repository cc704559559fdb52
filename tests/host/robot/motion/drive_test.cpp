#include "host/robot/motion/drive.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "host/robot/client/robot_problem.hpp"
#include "host/robot/motion/arming.hpp"
#include "host/robot/motion/drive_problem.hpp"
#include "host/robot/motion/paths.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/links/fake_link.hpp"

namespace astro::robot {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace)
using std::chrono::milliseconds;
using std::chrono::seconds;
using support::Tells;
using support::ThrowsTelling;
using test::FakeLink;
using test::FakeRobot;
using test::Fate;

TEST(Paths, SquareIsFourSidesAndFourExactQuarterTurns) {
  for (const Sense sense : {Sense::cw, Sense::ccw}) {
    const Path path = square(3, sense, {0.2, 0.5});
    ASSERT_EQ(path.size(), 8U);
    for (std::size_t i = 0; i < 8; i += 2) {
      EXPECT_EQ(path[i].kind, SegmentKind::line);
      EXPECT_EQ(path[i].length_nm, 3'000'000'000);
      EXPECT_EQ(path[i].speed_umps, 200'000);
      EXPECT_EQ(path[i + 1].kind, SegmentKind::spin);
      EXPECT_EQ(path[i + 1].angle, sense == Sense::cw ? -(std::int64_t{1} << 30) : std::int64_t{1} << 30);
      EXPECT_EQ(path[i + 1].yaw_rate_uradps, 500'000);
    }
  }
}

TEST(Paths, CircleGoesRoundByWholeTurnsAlongItsCircumference) {
  const Path path = circle(0.5, 2, Sense::cw);
  ASSERT_EQ(path.size(), 1U);
  EXPECT_EQ(path[0].kind, SegmentKind::arc);
  EXPECT_EQ(path[0].angle, -(std::int64_t{2} << 32));
  EXPECT_NEAR(static_cast<double>(path[0].length_nm), 2e9 * std::numbers::pi, 0.5);  // rounded to 1 nm
}

TEST(Paths, DegreesThatAreDyadicTurnsAreExact) {
  EXPECT_EQ(spin(turns_from_degrees(-45))[0].angle, -(std::int64_t{1} << 29));
  EXPECT_EQ(line(-0.25)[0].length_nm, -250'000'000);
}

TEST(Paths, RefusesWhatASegmentCannotHold) {
  EXPECT_THROW(line(std::nan("")), Error);
  EXPECT_THROW(line(1e12), Error);
  EXPECT_THROW(square(-1, Sense::cw), Error);
  EXPECT_THROW(circle(0, 1, Sense::cw), Error);
  EXPECT_THROW(line(1, {-1, 0}), Error);
}

class Drive : public testing::Test {
 protected:
  FakeLink link;
  Client client{link};
  void SetUp() override { client.connect(); }
};

TEST_F(Drive, WhatIsTooLargeIsToldInAFewDigits) {
  EXPECT_THAT([] { line(1e308); },
              ThrowsTelling(PathProblem::impossible_number, "a length in metres", "1e+308"));
  DriveSession session(client);
  EXPECT_THAT([&] { session.set_velocity(1e308, 0); },
              ThrowsTelling(PathProblem::impossible_number, "a speed in m/s", "1e+308"));
}

TEST_F(Drive, DoesNotBeginIfAnotherHasStoppedTheRobotSinceTheLastOne) {
  DriveSession(client).end();
  link.robot.stops_by_others = 2;
  const Remark why = support::told_by([&] { DriveSession{client}; });
  EXPECT_THAT(why, Tells(DriveProblem::stopped_by_another));
  EXPECT_THAT(why.values, testing::IsEmpty()) << "which program is not known";
  EXPECT_EQ(link.robot.executed[Arm::kId], 1);
  EXPECT_NO_THROW(DriveSession(client).end()) << "it knows by now, and so does whoever lets it go on";
}

TEST_F(Drive, DoesNotTakeOverARobotThatStaysArmedForSomebodyWhoMayHaveGone) {
  link.robot.mode = Mode::idle;
  EXPECT_THAT([&] { DriveSession{client}; }, ThrowsTelling(DriveProblem::armed_for_another));
  EXPECT_EQ(link.robot.executed[Arm::kId], 0);
}

TEST_F(Drive, OfAFreshProgramIsNotHeldUpByAnOldStop) {
  link.robot.stops_by_others = 7;
  EXPECT_NO_THROW(DriveSession(client).end());
}

TEST_F(Drive, DoesNotBeginIfTheStopComesWhileItPreparesToArm) {
  link.fate = [&](bool to_robot, std::uint8_t message) {
    if (to_robot && message == GetFaults::kId) ++link.robot.stops_by_others;
    return Fate::arrives;
  };
  EXPECT_THROW(DriveSession{client}, Error);
  EXPECT_EQ(link.robot.executed[Arm::kId], 0);
}

TEST_F(Drive, RunsAPathLongerThanTheQueueInOrderAndDisarmsAtTheEnd) {
  Path path = square(1, Sense::ccw);
  const Path again = path;
  path.insert(path.end(), again.begin(), again.end());
  std::vector<std::uint16_t> done;
  {
    DriveHooks hooks;
    hooks.segment_done = [&](const SegmentDone& event) { done.push_back(event.tag); };
    DriveSession session(client, hooks);
    session.run(path);
    EXPECT_EQ(link.robot.mode, Mode::idle);
  }
  EXPECT_EQ(link.robot.mode, Mode::disarmed);
  ASSERT_EQ(link.robot.segments.size(), 16U);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(link.robot.segments[i].angle, path[i].angle);
    EXPECT_EQ(done[i], i + 1);
  }
}

TEST_F(Drive, IsNotDelayedByWaitingForRoomInTheQueue) {
  const auto start = client.now();
  DriveSession(client).run(Path(20, line(1)[0]));
  const auto driven = microseconds(20 * FakeRobot::kSegment_us);
  EXPECT_LT(client.now() - start, driven + milliseconds(100));
}

TEST_F(Drive, EndsEvenIfAllItsEventsAreLost) {
  link.robot.mute_events = true;
  DriveSession session(client);
  session.run(square(1, Sense::cw));
  EXPECT_EQ(link.robot.segments.size(), 8U);
}

TEST_F(Drive, KeepsASimulatorInFastMotionGoing) {
  link.rate = 300;
  link.waits_after_us = 100'000;
  client.request(SetTelemetry{10, 0});
  const auto start = client.now();
  DriveSession(client).run(Path(40, line(1)[0]));  // 12 s of the robot's time
  EXPECT_LT(client.now() - start, milliseconds(200));
}

TEST_F(Drive, ClearsWhatAKilledProgramLeftBehindAndSaysSo) {
  link.robot.raise(Fault::command_timeout);
  link.robot.raise(Fault::link_lost);
  Remark notice;
  DriveHooks hooks;
  hooks.notice = [&](const Remark& remark) { notice = remark; };
  DriveSession(client, hooks).run(line(1));
  EXPECT_THAT(notice, Tells(DriveProblem::faults_left_behind, "command_timeout, link_lost"));
}

TEST_F(Drive, DoesNotClearAnyOtherFault) {
  link.robot.raise(Fault::link_lost);
  link.robot.raise(Fault::stall);
  EXPECT_THAT([&] { DriveSession session(client); },
              ThrowsTelling(RobotProblem::faulted, "link_lost, stall"));
  EXPECT_NE(link.robot.latched, 0U);
}

TEST_F(Drive, DoesNotClearAFaultThatComesWhileTheRobotRampsDown) {
  link.robot.raise(Fault::command_timeout);
  EXPECT_THAT([&] { clear_faults_left_behind(client, [&] { link.robot.raise(Fault::stall); }); },
              ThrowsTelling(RobotProblem::faulted, "command_timeout, stall"));
  EXPECT_EQ(link.robot.latched, bit(Fault::command_timeout) | bit(Fault::stall));
}

TEST_F(Drive, AFaultOnTheWayEndsItByName) {
  DriveHooks hooks;
  hooks.segment_done = [&](const SegmentDone&) { link.robot.raise(Fault::over_speed); };
  DriveSession session(client, hooks);
  try {
    session.run(square(1, Sense::cw));
    FAIL();
  } catch (const DriveFault& stopped) {
    EXPECT_EQ(stopped.fault(), Fault::over_speed);
    EXPECT_THAT(stopped.remark(), Tells(RobotProblem::faulted, "over_speed"));
  }
}

TEST_F(Drive, AFaultWhoseEventIsLostIsFoundByAsking) {
  DriveHooks hooks;
  hooks.segment_done = [&](const SegmentDone&) {
    link.robot.mute_events = true;
    link.robot.raise(Fault::stall);
  };
  DriveSession session(client, hooks);
  EXPECT_THROW(session.run(Path(3, line(1)[0])), DriveFault);
}

TEST_F(Drive, CtrlCStopsThenDisarms) {
  bool pressed = false;
  DriveHooks hooks;
  hooks.interrupted = [&] { return pressed; };
  hooks.segment_done = [&](const SegmentDone&) { pressed = true; };
  {
    DriveSession session(client, hooks);
    EXPECT_THROW(session.run(square(1, Sense::cw)), Interrupted);
  }
  EXPECT_EQ(link.robot.mode, Mode::disarmed);
  const auto& seen = link.robot.seen;
  const auto stop = std::find(seen.begin(), seen.end(), Stop::kId);
  ASSERT_NE(stop, seen.end());
  EXPECT_NE(std::find(stop, seen.end(), Disarm::kId), seen.end());
}

class InterruptedDrive : public Drive {
 protected:
  /// Drives until the first segment is done; `then` is called when Ctrl-C is pressed.
  template <class Then>
  void drive_until_ctrl_c(Then then) {
    DriveHooks hooks;
    hooks.interrupted = [&] { return pressed_; };
    hooks.segment_done = [&](const SegmentDone&) {
      if (!std::exchange(pressed_, true)) then();
    };
    DriveSession session(client, hooks);
    session.run(square(1, Sense::cw));
  }

  bool pressed_ = false;
};

TEST_F(InterruptedDrive, SaysSoOnlyOnceTheRobotConfirmedThatItIsAtRestAndDisarmed) {
  EXPECT_THROW(drive_until_ctrl_c([] {}), Interrupted);
  EXPECT_EQ(link.robot.mode, Mode::disarmed);
}

TEST_F(InterruptedDrive, OfARobotThatRefusesToStopDisarmsAndSaysThatTheStopIsNotConfirmed) {
  const auto drive = [&] {
    drive_until_ctrl_c([&] { link.robot.refuse_next = ErrorReply{ErrorCode::busy, 0}; });
  };
  EXPECT_THAT(drive, ThrowsTelling<NotStopped>(RobotProblem::refused, "Stop"));
  EXPECT_EQ(link.robot.mode, Mode::disarmed);
}

TEST_F(InterruptedDrive, OfARobotThatNoLongerAnswersSaysThatTheStopIsNotConfirmed) {
  EXPECT_THROW(drive_until_ctrl_c([&] { link.fate = [](bool, std::uint8_t) { return Fate::lost; }; }),
               NotStopped);
}

TEST_F(InterruptedDrive, OfARobotThatIsNotDisarmedSaysThatTheStopIsNotConfirmed) {
  EXPECT_THROW(drive_until_ctrl_c([&] {
                 link.fate = [](bool, std::uint8_t id) {
                   return id == Disarm::kId ? Fate::lost : Fate::arrives;
                 };
               }),
               NotStopped);
}

TEST_F(InterruptedDrive, EndsWithTheFaultThatWasLatchedOnTheWayToRest) {
  EXPECT_THROW(drive_until_ctrl_c([&] {
                 link.fate = [this](bool to_robot, std::uint8_t id) {
                   if (to_robot && id == Stop::kId) link.robot.raise(Fault::stall);
                   return Fate::arrives;
                 };
               }),
               DriveFault);
}

TEST_F(Drive, ThatFailsAndCannotStopTheRobotEitherSaysSoInANotice) {
  Remark notice;
  DriveHooks hooks;
  hooks.notice = [&](const Remark& remark) { notice = remark; };
  try {
    DriveSession session(client, hooks);
    link.fate = [](bool, std::uint8_t) { return Fate::lost; };
    throw Error("the disk is full");
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "the disk is full");
  }
  EXPECT_THAT(notice, Tells(DriveProblem::stop_unconfirmed));
}

TEST_F(Drive, ThatIsEndedTellsThatTheRobotDidNotConfirmIt) {
  DriveSession session(client);
  session.set_velocity(0.1, 0);
  link.fate = [](bool, std::uint8_t) { return Fate::lost; };
  EXPECT_THROW(session.end(), NotStopped);
}

TEST_F(Drive, SaysThatAnotherProgramStoppedTheRobot) {
  DriveHooks hooks;
  int driven = 0;
  hooks.segment_done = [&](const SegmentDone&) { ++driven; };
  DriveSession session(client, hooks);
  link.fate = [&, met = false](bool, std::uint8_t id) mutable {
    if (id == Ping::kId && !std::exchange(met, true)) {
      link.robot.receive(protocol::Frame(Stop{}, 999).bytes());
      for (std::uint16_t tag = 1; tag <= 3; ++tag)  // with those that wait behind it
        link.robot.event(SegmentDone{tag, SegmentOutcome::aborted, link.robot.device_us});
    }
    return Fate::arrives;
  };
  EXPECT_THAT([&] { session.run(line(1)); }, ThrowsTelling(DriveProblem::segment_aborted, "1"));
  EXPECT_EQ(driven, 0);
}

TEST_F(Drive, StoppingOneselfIsNoError) {
  DriveSession session(client);
  session.set_velocity(0.1, 0);
  session.stop();
  session.run(line(1));
}

TEST_F(Drive, ARestartOnTheWayIsALostLink) {
  DriveHooks hooks;
  hooks.segment_done = [&](const SegmentDone&) { link.robot.restart(); };
  DriveSession session(client, hooks);
  EXPECT_THROW(session.run(Path(3, line(1)[0])), LinkLost);
}

TEST_F(Drive, EndsQuietlyWhenTheLinkIsGone) {
  {
    DriveSession session(client);
    link.stays_away = seconds(100);
    link.drop();
  }
  EXPECT_EQ(link.robot.mode, Mode::idle) << "nobody could tell it";
}

}  // namespace
}  // namespace astro::robot
