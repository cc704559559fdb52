#include <gmock/gmock.h>

#include "common/protocol/messages.hpp"
#include "host/robot/sharing/driver_rule.hpp"
#include "host/robot/sharing/program_session.hpp"
#include "host/robot/sharing/request_arbiter.hpp"
#include "host/robot/sharing/robot_queue.hpp"
#include "host/robot/sharing/staging_area.hpp"
#include "host/robot/sharing/telemetry_stream.hpp"
#include "host/robot/sharing/turns.hpp"

namespace astro::robot {
namespace {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr SessionId kDriver = 1, kOther = 2, kThird = 3;

// ---- turns

TEST(Turns, GoInTheOrderOfAskingAndOneAtATime) {
  Turns turns;
  turns.wait(kOther);
  turns.wait(kThird);
  turns.wait(kOther);  // keeps its place, and gets no second one
  EXPECT_EQ(turns.next(milliseconds(0)), kOther);
  turns.begin(kOther, milliseconds(1000));
  EXPECT_TRUE(turns.has(kOther));
  EXPECT_EQ(turns.next(milliseconds(1)), std::nullopt) << "the turn lasts";
  turns.end(kOther);
  EXPECT_EQ(turns.next(milliseconds(2)), kThird);
  EXPECT_EQ(turns.next(milliseconds(3)), std::nullopt) << "nobody waits";
}

TEST(Turns, OneThatIsNotAnsweredEndsAtItsDeadline) {
  Turns turns;
  turns.begin(kOther, milliseconds(1000));
  EXPECT_EQ(turns.deadline(), std::nullopt) << "nobody waits for it";
  turns.wait(kThird);
  EXPECT_EQ(turns.deadline(), milliseconds(1000));
  EXPECT_EQ(turns.next(milliseconds(999)), std::nullopt);
  EXPECT_EQ(turns.next(milliseconds(1000)), kThird);
  EXPECT_FALSE(turns.has(kOther));
}

TEST(Turns, AProgramThatEndsLosesItsTurnAndItsPlace) {
  Turns turns;
  turns.begin(kOther, milliseconds(1000));
  turns.wait(kThird);
  turns.end(kThird);
  turns.end(kOther);
  EXPECT_EQ(turns.next(milliseconds(0)), std::nullopt);
}

// ---- the driver

class ADrive : public testing::Test {
 protected:
  ADrive() : rule(fresh_rule()) {
    rule.note_request(kDriver, Arm::kId);
    rule.note_answer(kDriver, Arm::kId, std::nullopt);
  }
  static DriverRule fresh_rule() {
    DriverRule fresh;
    for (const SessionId id : {kDriver, kOther, kThird}) fresh.join(id);
    return fresh;
  }
  std::optional<ErrorCode> refused(SessionId id, std::uint8_t message) const {
    const auto refusal = rule.refusal(id, message);
    return refusal ? std::optional(refusal->code) : std::nullopt;
  }
  static constexpr std::array kMotion{Velocity::kId, WheelVoltage::kId, AddSegment::kId, Rest::kId,
                                      Resume::kId};
  DriverRule rule;
};

TEST_F(ADrive, BelongsToTheFirstAndIsDeniedToOthersWhoMayStillAskAndStop) {
  EXPECT_EQ(rule.confirmed_driver(), kDriver);
  for (const std::uint8_t message : {Arm::kId, Velocity::kId, WheelVoltage::kId, AddSegment::kId}) {
    EXPECT_EQ(refused(kOther, message), ErrorCode::busy);
    EXPECT_EQ(refused(kDriver, message), std::nullopt);
  }
  for (const std::uint8_t message : {GetStatus::kId, Stop::kId, EmergencyStop::kId, Disarm::kId})
    EXPECT_EQ(refused(kOther, message), std::nullopt);
}

TEST_F(ADrive, IsConfirmedByTheRobotAndGivenBackIfItRefuses) {
  DriverRule fresh = fresh_rule();
  fresh.note_request(kOther, Arm::kId);
  EXPECT_EQ(fresh.driver(), kOther);
  EXPECT_EQ(fresh.confirmed_driver(), std::nullopt);
  EXPECT_EQ(fresh.refusal(kOther, Velocity::kId)->code, ErrorCode::not_armed)
      << "the robot has not agreed yet";
  fresh.note_answer(kOther, Arm::kId, ErrorCode::faulted);
  EXPECT_EQ(fresh.driver(), std::nullopt);
  rule.note_answer(kDriver, Velocity::kId, ErrorCode::moving);
  EXPECT_EQ(rule.driver(), kDriver) << "one refused velocity does not end a drive";
  EXPECT_EQ(refused(kDriver, Velocity::kId), std::nullopt);
}

TEST_F(ADrive, EndsByDisarmRebootAndBootLoaderOfAnybodyOnceTheRobotHasAcceptedThem) {
  for (const std::uint8_t message : {Disarm::kId, Reboot::kId, EnterBootloader::kId}) {
    DriverRule each = rule;
    each.note_answer(kOther, message, ErrorCode::moving);
    EXPECT_EQ(each.driver(), kDriver);
    each.note_answer(kOther, message, std::nullopt);
    EXPECT_EQ(each.driver(), std::nullopt);
  }
}

TEST_F(ADrive, ThatAnotherStoppedResumesOnlyByArming) {
  rule.note_halt(kOther, Stop::kId, {22, "astrolabe stop"});
  rule.note_halt(kThird, Stop::kId, {33, "too late"});
  ASSERT_NE(rule.stopper_of(kDriver), nullptr);
  EXPECT_EQ(rule.stopper_of(kDriver)->pid, 22U) << "the first of two";
  for (const std::uint8_t message : kMotion) EXPECT_EQ(refused(kDriver, message), ErrorCode::not_armed);
  EXPECT_EQ(rule.confirmed_driver(), std::nullopt) << "nobody drives";
  EXPECT_EQ(refused(kDriver, Arm::kId), std::nullopt);
  EXPECT_EQ(refused(kOther, Arm::kId), std::nullopt) << "the place is free";
  rule.note_answer(kDriver, Arm::kId, ErrorCode::faulted);
  EXPECT_EQ(refused(kDriver, Velocity::kId), ErrorCode::not_armed);
  rule.note_answer(kDriver, Arm::kId, std::nullopt);
  EXPECT_EQ(refused(kDriver, Velocity::kId), std::nullopt);
  EXPECT_EQ(rule.stopper_of(kDriver), nullptr);
}

TEST_F(ADrive, ThatIsOverIsStillTheBusinessOfItsDriverWhichMayHaveMoreToDrive) {
  rule.note_halt(kDriver, Disarm::kId, {11, "astrolabe umbmark"});
  rule.note_answer(kDriver, Disarm::kId, std::nullopt);
  const int told = rule.tell_stops(kDriver, 5);
  EXPECT_EQ(refused(kDriver, Arm::kId), std::nullopt);
  rule.note_halt(kThird, Stop::kId, {33, "astrolabe stop"});
  EXPECT_EQ(refused(kDriver, Arm::kId), ErrorCode::not_armed) << "it cannot know yet";
  EXPECT_EQ(refused(kOther, Arm::kId), std::nullopt) << "a program that never asked begins now";
  EXPECT_EQ(rule.tell_stops(kDriver, 5), told + 1);
  EXPECT_EQ(rule.stopper_of(kDriver)->pid, 33U);
  EXPECT_EQ(refused(kDriver, Arm::kId), std::nullopt) << "it knows";
  rule.note_request(kDriver, Arm::kId);
  rule.note_answer(kDriver, Arm::kId, std::nullopt);
  EXPECT_EQ(rule.stopper_of(kDriver), nullptr);
}

TEST_F(ADrive, OfAnotherMayBeEndedByThatOneWithoutStoppingWhoDroveBefore) {
  rule.note_answer(kDriver, Disarm::kId, std::nullopt);
  rule.note_request(kOther, Arm::kId);
  rule.note_answer(kOther, Arm::kId, std::nullopt);
  const int told = rule.tell_stops(kDriver, 0);
  rule.note_halt(kOther, Stop::kId, {22, "astrolabe drive"});
  rule.end_drive();  // by a fault
  rule.note_halt(kOther, Disarm::kId, {22, "astrolabe drive"});
  EXPECT_EQ(rule.stopper_of(kDriver), nullptr);
  EXPECT_EQ(rule.tell_stops(kDriver, 0), told);
}

TEST_F(ADrive, ThatTheDriverStoppedItselfResumesOnlyByArmingToo) {
  rule.note_halt(kDriver, Stop::kId, {11, "astrolabe drive"});
  EXPECT_EQ(rule.stopper_of(kDriver), nullptr) << "it knows who it was";
  EXPECT_EQ(refused(kDriver, Velocity::kId), ErrorCode::not_armed);
  rule.note_answer(kDriver, Arm::kId, std::nullopt);
  EXPECT_EQ(refused(kDriver, Velocity::kId), std::nullopt);
}

TEST_F(ADrive, ThatAnotherPausedTakesSegmentsAndNoVelocityUntilAnotherResumes) {
  rule.note_halt(kOther, Pause::kId, {22, "astrolabe pause"});
  EXPECT_EQ(refused(kDriver, Velocity::kId), ErrorCode::not_armed);
  EXPECT_EQ(refused(kDriver, Resume::kId), ErrorCode::not_armed);
  EXPECT_EQ(refused(kDriver, AddSegment::kId), std::nullopt);
  EXPECT_EQ(refused(kThird, Arm::kId), ErrorCode::busy) << "a paused path is still somebody's";
  EXPECT_EQ(refused(kOther, Resume::kId), std::nullopt);
  rule.note_answer(kOther, Resume::kId, std::nullopt);
  EXPECT_EQ(refused(kDriver, Velocity::kId), std::nullopt);
}

TEST_F(ADrive, ThatSomebodyAtAnotherPortStoppedIsOverForThisPortToo) {
  rule.note_answer(kDriver, Velocity::kId, ErrorCode::not_armed);
  EXPECT_EQ(rule.driver(), kDriver) << "its frames still keep the armed robot alive";
  EXPECT_EQ(refused(kDriver, AddSegment::kId), ErrorCode::not_armed);
  EXPECT_EQ(refused(kOther, Arm::kId), std::nullopt);
}

TEST_F(ADrive, WhoseArmWasCancelledByAStopLeavesThePlaceFree) {
  DriverRule fresh = fresh_rule();
  fresh.note_request(kOther, Arm::kId);
  fresh.note_halt(kThird, Stop::kId, {33, "astrolabe stop"});
  fresh.note_answer(kOther, Arm::kId, ErrorCode::not_armed);
  EXPECT_EQ(fresh.refusal(kThird, Arm::kId), std::nullopt);
}

TEST_F(ADrive, BeginsWithTheRobotsWordThoughADisarmWasAnsweredInBetween) {
  DriverRule fresh = fresh_rule();
  fresh.note_halt(kThird, Disarm::kId, {33, "astrolabe stop"});
  fresh.note_request(kOther, Arm::kId);
  fresh.note_answer(kThird, Disarm::kId, std::nullopt);
  fresh.note_answer(kOther, Arm::kId, std::nullopt);
  EXPECT_EQ(fresh.confirmed_driver(), kOther);
  EXPECT_EQ(fresh.refusal(kOther, Velocity::kId), std::nullopt);
}

TEST_F(ADrive, ThatSomebodyAtAnotherPortPausedIsNotOverBecauseAResumeWasRefused) {
  rule.note_answer(kDriver, Resume::kId, ErrorCode::not_armed);
  EXPECT_EQ(refused(kDriver, AddSegment::kId), std::nullopt);
  EXPECT_EQ(refused(kOther, Arm::kId), ErrorCode::busy);
}

TEST_F(ADrive, AtAnotherPortIsResumedThroughThisOne) {
  const DriverRule fresh;
  EXPECT_EQ(fresh.refusal(kOther, Resume::kId), std::nullopt);
}

TEST_F(ADrive, OfAProgramThatHasGoneIsNobodyElses) {
  rule.release(kDriver);
  EXPECT_EQ(refused(kOther, Velocity::kId), ErrorCode::not_armed) << "the robot may still be armed";
  EXPECT_EQ(refused(kOther, Arm::kId), std::nullopt);
}

// ---- the staging area

TEST(StagingArea, IsLeftToTheRobotUntilAProgramOpensIt) {
  StagingArea area;
  EXPECT_TRUE(area.allows(kOther, StageParameter::kId));
  EXPECT_FALSE(area.hides_from(kOther));
}

TEST(StagingArea, BelongsToWhoeverOpenedItLast) {
  for (const std::uint8_t open : {RevertParameters::kId, DefaultParameters::kId}) {
    StagingArea area;
    EXPECT_TRUE(area.allows(kDriver, RevertParameters::kId));
    EXPECT_TRUE(area.allows(kOther, open));
    for (const std::uint8_t message : {StageParameter::kId, CommitParameters::kId, ApplyParameters::kId}) {
      EXPECT_FALSE(area.allows(kDriver, message));
      EXPECT_TRUE(area.allows(kOther, message));
    }
    EXPECT_TRUE(area.hides_from(kDriver));
    EXPECT_FALSE(area.hides_from(kOther));
    area.release(kOther);
    EXPECT_FALSE(area.allows(kOther, CommitParameters::kId)) << "closed until it is opened again";
  }
}

TEST(StagingArea, TheStagedValueIsReplacedByTheActiveOneAndNothingElseIs) {
  ParameterValue value;
  value.id = 3;
  value.active = 7;
  value.staged = 8;
  const auto shown = decode<ParameterValue>(without_staged(body_of(value, 41)));
  ASSERT_TRUE(shown.ok());
  EXPECT_EQ(shown->id, 3);
  EXPECT_EQ(shown->active, 7);
  EXPECT_EQ(shown->staged, 7);
  EXPECT_EQ(peek(without_staged(body_of(value, 41)))->request_id, 41);
  const Bytes other = body_of(Ack{}, 41);
  EXPECT_EQ(without_staged(other), other);
}

// ---- telemetry

std::optional<SetTelemetry> setting_of(TelemetryStream& stream) {
  const auto request = stream.next_request();
  if (!request) return std::nullopt;
  const auto setting = decode<SetTelemetry>(request->body);
  return setting.ok() ? std::optional(*setting) : std::nullopt;
}

TEST(TelemetryStream, AsksTheRobotOnceForWhatServesAll) {
  TelemetryStream stream;
  EXPECT_EQ(setting_of(stream), std::nullopt) << "nobody has asked";
  stream.request(kDriver, {10, Telemetry::kPose});
  stream.request(kOther, {100, Telemetry::kBattery});
  EXPECT_EQ(setting_of(stream), (SetTelemetry{10, Telemetry::kPose | Telemetry::kBattery}));
  EXPECT_EQ(setting_of(stream), std::nullopt);
  stream.release(kDriver);
  EXPECT_EQ(setting_of(stream), (SetTelemetry{100, Telemetry::kBattery}));
  stream.release(kThird);  // has requested nothing
  EXPECT_EQ(setting_of(stream), std::nullopt);
  stream.renew();
  EXPECT_EQ(setting_of(stream), (SetTelemetry{100, Telemetry::kBattery}));
}

TEST(TelemetryStream, EachRequestOfItsOwnHasANewId) {
  TelemetryStream stream;
  stream.renew();
  const std::uint16_t first = stream.next_request()->header.request_id;
  stream.renew();
  EXPECT_NE(stream.next_request()->header.request_id, first) << "the robot would answer from its memory";
  EXPECT_NE(first, 0);
}

TEST(TelemetryStream, AfterARestartNobodyGetsASampleUntilItAsksAgain) {
  TelemetryStream stream;
  stream.request(kDriver, {10, Telemetry::kPose});
  setting_of(stream);
  Telemetry sample;
  sample.device_time_us = 5'000'000;
  sample.fields = Telemetry::kPose | Telemetry::kBattery;
  const auto part = stream.part_for(kDriver, sample);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->fields, Telemetry::kPose);
  EXPECT_FALSE(stream.part_for(kOther, sample));
  stream.clear();
  sample.device_time_us += 1'000'000;
  EXPECT_FALSE(stream.part_for(kDriver, sample));
  EXPECT_EQ(setting_of(stream), std::nullopt);
}

// ---- frames for the robot

template <Message M>
Exchange exchange_of(const M& message, std::uint16_t id) {
  return {{M::kId, id}, body_of(message, id)};
}

TEST(RobotQueue, ARequestKeepsItsIdAndTheDriversHasBit15Clear) {
  RobotQueue queue;
  Exchange drivers = exchange_of(Velocity{}, 7), others = exchange_of(GetStatus{}, 7);
  queue.send(drivers, true, milliseconds(1));
  queue.send(others, false, milliseconds(1));
  EXPECT_FALSE(drivers.has_onlookers_id());
  EXPECT_TRUE(others.has_onlookers_id());
  const std::uint16_t id = others.robot_id;
  const Bytes frame = others.frame;
  queue.send(others, true, milliseconds(60));  // drives meanwhile
  EXPECT_EQ(others.robot_id, id);
  EXPECT_EQ(others.frame, frame);
  EXPECT_EQ(others.sent_at, milliseconds(60));
  EXPECT_EQ(queue.frames().frames(), 3U);
}

TEST(RobotQueue, IdsNeverBecomeZeroNorTakeTheOtherBit) {
  RobotQueue queue;
  for (int i = 0; i < 0x10000; ++i) {
    Exchange exchange = exchange_of(Ping{}, 1);
    queue.send(exchange, true, milliseconds(1));
    ASSERT_NE(exchange.robot_id, 0) << i;
    ASSERT_FALSE(exchange.has_onlookers_id()) << i;
  }
}

TEST(RobotQueue, APauseFindsRoomWhereNothingElseDoesAndGoesLast) {
  RobotQueue queue;
  for (std::uint16_t i = 1; i <= 1000; ++i) {
    Exchange exchange = exchange_of(GetStatus{}, i);
    queue.send(exchange, false, milliseconds(1));
  }
  Exchange pause = exchange_of(Pause{}, 1);
  queue.send(pause, false, milliseconds(1));
  EXPECT_EQ(queue.frames().frames(), 257U);
  while (queue.frames().frames() > 1) queue.frames().taken(queue.frames().front().size());
  const auto last = queue.frames().front();
  EXPECT_EQ(Bytes(last.begin(), last.end()), pause.frame);
}

TEST(RobotQueue, AStopFindsRoomWhereNothingElseDoes) {
  RobotQueue queue;
  for (std::uint16_t i = 1; i <= 1000; ++i) {
    Exchange exchange = exchange_of(GetStatus{}, i);
    queue.send(exchange, false, milliseconds(1));
  }
  const std::size_t full = queue.frames().frames();
  EXPECT_EQ(full, 256U);
  Exchange stop = exchange_of(EmergencyStop{}, 1);
  queue.send(stop, false, milliseconds(1));
  EXPECT_EQ(queue.frames().frames(), full + 1);
  const auto front = queue.frames().front();
  EXPECT_EQ(Bytes(front.begin(), front.end()), stop.frame) << "and goes first";
}

TEST(Exchange, AnAnswerThatComesLaterThanIdsAreReusedIsNotItsOwn) {
  RobotQueue queue;
  Exchange exchange = exchange_of(GetStatus{}, 7);
  queue.send(exchange, true, seconds(10));
  const Header answer{Ack::kId, exchange.robot_id};
  EXPECT_TRUE(exchange.is_answered_by(answer, seconds(13) - milliseconds(1)));
  EXPECT_FALSE(exchange.is_answered_by(answer, seconds(13)));
  EXPECT_FALSE(exchange.is_answered_by({Ack::kId, 99}, seconds(10)));
}

// ---- one program

TEST(ProgramSession, OfFivePingsTheOldestIsForgotten) {
  ProgramSession session(kDriver, {});
  RobotQueue queue;
  std::vector<std::uint16_t> ids;
  for (std::uint16_t i = 1; i <= 5; ++i) {
    Exchange& ping = session.ping({Ping::kId, i}, body_of(Ping{}, i));
    queue.send(ping, true, milliseconds(1));
    ids.push_back(ping.robot_id);
  }
  EXPECT_EQ(session.take_pong({Pong::kId, ids[0]}, milliseconds(2)), std::nullopt);
  for (std::uint16_t i = 1; i < 5; ++i) {
    EXPECT_EQ(session.take_pong({Pong::kId, ids[i]}, milliseconds(2)),
              (Header{Ping::kId, static_cast<std::uint16_t>(i + 1)}));
    EXPECT_EQ(session.take_pong({Pong::kId, ids[i]}, milliseconds(2)), std::nullopt) << "answered once";
  }
}

// ---- all together

TEST(RequestArbiter, RepliesGoToTheProgramThatAskedWithItsOwnIdAndAreTakenOnce) {
  RequestArbiter requests;
  requests.join(kDriver, {11, "one"});
  requests.join(kOther, {22, "two"});
  requests.take(kOther, body_of(GetPortUsers{}, 800), milliseconds(1));
  const auto replies = requests.take_replies();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].to, kOther);
  EXPECT_EQ(replies[0].frame, frame_of(body_of(PortUsers{}, 800))) << "nobody drives";
  EXPECT_TRUE(requests.take_replies().empty());
  EXPECT_TRUE(requests.to_robot().empty()) << "the robot is not asked";
}

TEST(RequestArbiter, AreNamedByProgramOnceTheRobotHasAcceptedTheDrive) {
  RequestArbiter requests;
  requests.join(kDriver, {11, "one"});
  requests.join(kOther, {22, "two"});
  requests.take(kDriver, body_of(Arm{}, 5), milliseconds(1));
  Framer framer;
  Header at_robot;
  for (const std::uint8_t byte : requests.to_robot().front())
    if (const auto body = framer.push(byte)) at_robot = *peek(*body);
  EXPECT_EQ(at_robot.message_id, Arm::kId);
  requests.take_answer(body_of(Ack{}, at_robot.request_id), milliseconds(2));
  const auto replies = requests.take_replies();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].frame, frame_of(body_of(Ack{}, 5)));
  requests.take(kOther, body_of(GetPortUsers{}, 6), milliseconds(3));
  PortUsers users;
  users.driver_pid = 11;
  users.driver_command = CommandLine("one");
  EXPECT_EQ(requests.take_replies().at(0).frame, frame_of(body_of(users, 6)));
}

}  // namespace
}  // namespace astro::robot
