#include <gtest/gtest.h>

#include "common/protocol/frame.hpp"
#include "common/protocol/framer.hpp"
#include "tests/support/robots/bench_robot.hpp"

// What the robot does with frames: repeated, malformed, of other versions, on two ports, without a reader.
namespace astro {
namespace {

using protocol::ErrorCode;

class Frames : public support::RobotOnBench {
 protected:
  struct Answer {
    protocol::Header header;
    std::vector<std::uint8_t> body;
  };

  void send(std::span<const std::uint8_t> bytes, int port = 1) { board().ports().host_write(port, bytes); }
  template <class Message>
  void send(const Message& message, std::uint16_t request, int port = 1) {
    send(protocol::Frame(message, request).bytes(), port);
  }
  void send_body(std::vector<std::uint8_t> body) {
    std::array<std::uint8_t, protocol::kMaxFrame> out{};
    send(std::span(out).first(protocol::encode_frame(body, out)));
  }
  std::vector<Answer> received(int port = 1) {
    silence_ms(2);
    std::vector<Answer> answers;
    std::array<std::uint8_t, 512> bytes{};
    for (std::size_t count; (count = board().ports().host_read(port, bytes)) != 0;)
      for (std::size_t i = 0; i < count; ++i)
        if (const auto body = framers_[static_cast<std::size_t>(port)].push(bytes[i]))
          answers.push_back({*protocol::peek(*body), {body->begin(), body->end()}});
    return answers;
  }
  ErrorCode error(const Answer& answer) {
    const auto decoded = protocol::decode<protocol::ErrorReply>(answer.body);
    EXPECT_TRUE(decoded.ok());
    return decoded.ok() ? decoded->code : ErrorCode::unsupported;
  }

  std::array<protocol::Framer, 2> framers_;
};

TEST_F(Frames, ARepeatedRequestIsAnsweredAgainAndCarriedOutOnce) {
  received();  // Booted
  send(protocol::Arm{}, 1);
  send(robot::line(1).front(), 2);
  send(robot::line(1).front(), 2);
  const auto all = received();
  const auto replies = std::count_if(all.begin(), all.end(), [](const Answer& one) {
    return one.header.request_id != 0;  // events have none
  });
  EXPECT_EQ(replies, 3);
  EXPECT_EQ(drive().queued() + (drive().mode() == protocol::Mode::segment ? 1U : 0U), 1U);
}

TEST_F(Frames, WhatStopsTheRobotIsCarriedOutEachTimeThoughItsIdHasComeRound) {
  const auto drive_on = [&] {
    send(protocol::ClearFaults{}, 1);
    send(protocol::Arm{}, 2);
    send(protocol::Velocity{300'000, 0}, 3);
    received();
    ASSERT_EQ(drive().mode(), protocol::Mode::velocity);
  };
  constexpr std::uint16_t kId = protocol::kOnlookerBit + 7;
  drive_on();
  send(protocol::EmergencyStop{}, kId);
  received();
  ASSERT_EQ(drive().mode(), protocol::Mode::fault);
  drive_on();
  send(protocol::EmergencyStop{}, kId);
  received();
  EXPECT_EQ(drive().mode(), protocol::Mode::fault);
  drive_on();
  for (int i = 0; i < 2; ++i) {
    send(protocol::Disarm{}, kId + 1);
    received();
    EXPECT_EQ(drive().mode(), protocol::Mode::disarmed) << i;
    drive_on();
  }
  for (int i = 0; i < 2; ++i) {
    send(protocol::Stop{}, kId + 2);
    received();
    EXPECT_NE(drive().mode(), protocol::Mode::velocity) << i;
    run_ms(1000);
    drive_on();
  }
}

TEST_F(Frames, APauseIsCarriedOutEachTimeThoughItsIdHasComeRound) {
  ask(protocol::Arm{});
  ask(robot::line(1).front());
  for (int i = 0; i < 2; ++i) {
    run_ms(500);
    ASSERT_EQ(drive().mode(), protocol::Mode::segment);
    send(protocol::Pause{}, protocol::kOnlookerBit + 7);
    run_ms(1000);
    EXPECT_EQ(drive().mode(), protocol::Mode::paused) << i;
    send(protocol::Resume{}, static_cast<std::uint16_t>(protocol::kOnlookerBit + 8 + i));
    run_ms(1);
  }
}

TEST_F(Frames, AFaultThatIsClearedInTheTurnInWhichItCameIsToldAndLogged) {
  received();
  send(protocol::EmergencyStop{}, 1);
  send(protocol::ClearFaults{}, 2);
  const auto all = received();
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Answer& one) {
    return one.header.message_id == protocol::FaultRaised::kId;
  }));
  run_ms(100);
  EXPECT_EQ(ask(protocol::GetFaults{}).raised_count, 1U);
  EXPECT_EQ(ask(protocol::GetFaultLog{0}).fault, static_cast<std::uint8_t>(Fault::emergency_stop));
}

TEST_F(Frames, APingInBetweenDoesNotMakeTheRobotForget) {
  send(protocol::Arm{}, 1);
  send(robot::line(1).front(), 2);
  send(protocol::Ping{}, 3);
  send(robot::line(1).front(), 2);
  received();
  EXPECT_EQ(drive().queued() + (drive().mode() == protocol::Mode::segment ? 1U : 0U), 1U);
}

constexpr std::uint16_t kOnlooker = protocol::kOnlookerBit;

TEST_F(Frames, AnOnlookersRequestDoesNotMakeTheRobotForgetTheDriversNorTheOtherWayRound) {
  received();
  send(protocol::Arm{}, 1);
  send(robot::line(1).front(), 2);
  send(protocol::GetStatus{}, kOnlooker + 2);
  send(robot::line(1).front(), 2);
  received();
  EXPECT_EQ(drive().queued() + (drive().mode() == protocol::Mode::segment ? 1U : 0U), 1U);
  send(protocol::Stop{}, kOnlooker + 3);
  send(protocol::Ping{}, 3);
  send(protocol::Stop{}, kOnlooker + 3);
  const auto answers = received();
  const auto acks = std::count_if(answers.begin(), answers.end(),
                                  [](const Answer& one) { return one.header.request_id == kOnlooker + 3; });
  EXPECT_EQ(acks, 2) << "each is answered under its own id";
}

TEST_F(Frames, AnOnlookerAtTheDriversPortDoesNotKeepADriveAlive) {
  ask(protocol::Arm{});
  ask(robot::line(5).front());  // from port 0, whose owner then falls silent
  for (std::uint16_t i = 0; i < 30; ++i) {
    send(protocol::GetStatus{}, kOnlooker + 1 + i, 0);
    send(protocol::Hello{}, kOnlooker + 100 + i, 0);
    silence_ms(100);
  }
  EXPECT_EQ(drive().faults().first(), Fault::link_lost);
}

TEST_F(Frames, AnOnlookerWhoseMotionIsTakenIsTheDriverAndItsFramesAreTheSignsOfLife) {
  send(protocol::Arm{}, kOnlooker + 1);
  send(robot::line(0.5).front(), kOnlooker + 2);
  for (std::uint16_t i = 0; i < 30; ++i) {
    send(protocol::Ping{}, kOnlooker + 10 + i);
    silence_ms(100);
  }
  EXPECT_EQ(drive().faults().mask(), 0U);
  EXPECT_NEAR(board().truth().x_m, 0.5, 0.005);
  send(robot::line(5).front(), kOnlooker + 50);
  for (std::uint16_t i = 0; i < 30; ++i) {
    send(protocol::Ping{}, 10 + i);  // of the port's owner, who does not drive
    silence_ms(100);
  }
  EXPECT_EQ(drive().faults().first(), Fault::link_lost);
}

TEST_F(Frames, AHelloOfAnOnlookerIsAnsweredAndBeginsNoSession) {
  ask(protocol::Arm{});
  ask(protocol::SetTelemetry{100, protocol::Telemetry::kBattery});
  ask(protocol::RevertParameters{});
  ask(robot::line(0.5).front());
  int samples = 0;
  const auto telemetry = client_.on<protocol::Telemetry>([&](const auto&) { ++samples; });
  for (std::uint16_t i = 0; i < 6; ++i) {
    send(protocol::Hello{}, kOnlooker + 1 + i, 0);
    run_ms(500);  // the driver goes on
  }
  EXPECT_EQ(drive().faults().mask(), 0U);
  EXPECT_NEAR(board().truth().x_m, 0.5, 0.005);
  EXPECT_NEAR(samples, 30, 1) << "its telemetry goes on";
  EXPECT_EQ(client_.counts().stale_replies, 6U) << "each Hello was answered";
  ask(protocol::CommitParameters{});  // the staging area is still the owner's
}

TEST_F(Frames, AnOnlookerStopsWhatTheDriverDrives) {
  for (int i = 0; i < 3; ++i) {
    ask(protocol::ClearFaults{});
    ask(protocol::Arm{});
    ask(robot::line(5).front());
    run_ms(300);
    if (i == 0) send(protocol::Stop{}, kOnlooker + 1, 0);
    if (i == 1) send(protocol::Disarm{}, kOnlooker + 2, 0);
    if (i == 2) send(protocol::EmergencyStop{}, kOnlooker + 3, 0);
    run_ms(2500);
    EXPECT_EQ(drive().running_tag(), 0) << i;
    EXPECT_EQ(mode(), i == 0   ? protocol::Mode::idle
                      : i == 1 ? protocol::Mode::disarmed
                               : protocol::Mode::fault);
  }
}

TEST_F(Frames, ARequestWithId0IsNeitherCarriedOutNorAnswered) {
  received();
  send(protocol::Arm{}, 0);
  send(protocol::Ping{}, 0);
  send(protocol::Hello{}, 0);
  EXPECT_TRUE(received().empty());
  EXPECT_EQ(mode(), protocol::Mode::disarmed);
}

TEST_F(Frames, ANewSessionMayReuseIds) {
  send(protocol::Arm{}, 1);
  received();
  send(protocol::Hello{}, 1);
  send(robot::line(1).front(), 2);
  received();
  EXPECT_EQ(drive().mode(), protocol::Mode::idle) << "another program armed";
  send(protocol::Arm{}, 1);  // were it taken for the one before the Hello, it would not be carried out
  send(robot::line(1).front(), 3);
  received();
  EXPECT_EQ(drive().mode(), protocol::Mode::segment);
}

TEST_F(Frames, AnOnlookerAtAnotherPortDoesNotKeepADriveAlive) {
  ask(protocol::Arm{});
  ask(robot::line(5).front());  // from port 0, which then falls silent
  for (int i = 0; i < 30; ++i) {
    send(protocol::Ping{}, 1, 1);
    silence_ms(100);
  }
  EXPECT_EQ(drive().faults().first(), Fault::link_lost);
}

TEST_F(Frames, ANewSessionDoesNotKeepTheDriveOfTheLastOneAlive) {
  ask(protocol::Arm{});
  ask(robot::line(5).front());
  run_ms(300);
  client_.connect();
  run_ms(6000);  // pings all the time
  EXPECT_EQ(drive().faults().first(), Fault::link_lost) << "armed, and its host has gone";
}

TEST_F(Frames, AProgramThatOpensTheDriversPortMeansThatTheDriverHasGoneAndStopsTheRobot) {
  ask(protocol::RevertParameters{});
  ask(protocol::StageParameter{static_cast<std::uint16_t>(Param::command_timeout), 0, {}});
  ask(protocol::CommitParameters{});
  for (const bool paused : {false, true}) {
    ask(protocol::Arm{});
    ask(robot::line(5).front());
    run_ms(1500);
    if (paused) ask(protocol::Pause{});
    client_.connect();
    EXPECT_EQ(drive().queued(), 0U);
    run_ms(3000);  // the longest ramp, and the wheels
    EXPECT_EQ(mode(), protocol::Mode::idle);
    const double stands_at_m = board().truth().x_m;
    send(protocol::Resume{}, 1);
    received();
    run_ms(500);
    EXPECT_NEAR(board().truth().x_m, stands_at_m, 0.002) << "nobody resumes what it has left";
  }
}

TEST_F(Frames, AfterTheDriverSaidHelloTrafficAtNoPortKeepsItsDriveAlive) {
  for (const int driver : {0, 1}) {
    const int other = 1 - driver;
    send(protocol::Hello{}, 100, driver);
    send(protocol::Arm{}, 101, driver);
    send(robot::line(5).front(), 102, driver);
    silence_ms(150);
    send(protocol::Hello{}, 103, driver);
    for (std::uint16_t i = 0; i < 60; ++i) {
      send(protocol::Ping{}, static_cast<std::uint16_t>(110 + i), other);
      silence_ms(100);
      received(0);
      received(1);
    }
    EXPECT_EQ(drive().faults().first(), Fault::link_lost) << "driver at port " << driver;
    send(protocol::ClearFaults{}, 104, driver);
    silence_ms(2);
  }
}

TEST_F(Frames, WhoPausesAndResumesAtAnotherPortLeavesTheDriveToItsDriver) {
  ask(protocol::Arm{});
  ask(robot::line(0.5).front());
  run_ms(500);
  send(protocol::Pause{}, 1);
  run_ms(1000);
  ASSERT_EQ(mode(), protocol::Mode::paused);
  send(protocol::Resume{}, 2);  // and then port 1 is silent
  run_ms(3000);
  EXPECT_EQ(drive().faults().mask(), 0U);
  EXPECT_NEAR(board().truth().x_m, 0.5, 0.005);
}

TEST_F(Frames, APathThatIsResumedAfterItsDriverHasGoneEndsByTheTimeout) {
  ask(protocol::Arm{});
  ask(robot::line(0.5).front());
  run_ms(500);
  ask(protocol::Pause{});
  run_ms(1000);
  silence_ms(1000);  // the driver has gone
  const double paused_at_m = board().truth().x_m;
  for (int i = 0; i < 30; ++i) {
    send(protocol::Resume{}, static_cast<std::uint16_t>(1 + i));  // repeating it does not help
    silence_ms(100);
  }
  EXPECT_EQ(drive().faults().first(), Fault::link_lost);
  EXPECT_TRUE(open());
  EXPECT_NEAR(board().truth().x_m, paused_at_m, 0.01);
}

TEST_F(Frames, TheStatusCountsWhatHostsAtOtherPortsHaveStopped) {
  const auto stops = [&] { return ask(protocol::GetStatus{}).stops_by_others; };
  ask(protocol::Arm{});
  ask(protocol::Stop{});
  ask(protocol::Disarm{});
  send(protocol::Stop{}, protocol::kOnlookerBit + 1, 0);
  silence_ms(2);
  EXPECT_EQ(stops(), 0) << "whoever shares the port knows of that one";
  send(protocol::Stop{}, 1);
  send(protocol::Disarm{}, 2);
  send(protocol::EmergencyStop{}, 3);
  received();
  EXPECT_EQ(stops(), 3);
  ask(protocol::Hello{});
  EXPECT_EQ(stops(), 3) << "a program that has lost its line for a moment still learns of them";
  send(protocol::GetStatus{}, 4);
  const auto answers = received();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(protocol::decode<protocol::Status>(answers[0].body)->stops_by_others, 1)
      << "at the other port: that of the onlooker, for the driver has ended its own drive";
}

TEST_F(Frames, WhoEndsItsOwnDriveStopsNobodyElse) {
  ask(protocol::Arm{});
  ask(protocol::Disarm{});
  send(protocol::Arm{}, 1);
  send(protocol::Stop{}, 2);
  send(protocol::Disarm{}, 3);
  received();
  EXPECT_EQ(ask(protocol::GetStatus{}).stops_by_others, 0);
  send(protocol::Disarm{}, protocol::kOnlookerBit + 4);
  received();
  EXPECT_EQ(ask(protocol::GetStatus{}).stops_by_others, 1);
}

TEST_F(Frames, AnArmOfAHostThatCannotKnowOfAStopIsRefused) {
  ask(protocol::Arm{});
  ask(protocol::Disarm{});
  ask(protocol::GetStatus{});
  send(protocol::Stop{}, 1);
  received();
  EXPECT_EQ(refusal(protocol::Arm{}).code(), ErrorCode::not_armed);
  EXPECT_EQ(mode(), protocol::Mode::disarmed);
  ask(protocol::GetStatus{});
  ask(protocol::Arm{});
  EXPECT_EQ(mode(), protocol::Mode::idle);
}

TEST_F(Frames, NobodyElseArmsDuringADriveNorWhileItIsPaused) {
  received();
  ask(protocol::Arm{});
  ask(robot::line(0.5).front());
  run_ms(500);
  send(protocol::Arm{}, 1);
  EXPECT_EQ(error(received().back()), ErrorCode::moving);
  ask(protocol::Pause{});
  run_ms(1000);
  received();
  send(protocol::Arm{}, 2);
  EXPECT_EQ(error(received().back()), ErrorCode::moving);
  ask(protocol::Resume{});
  run_ms(3000);
  EXPECT_EQ(drive().faults().mask(), 0U);
  EXPECT_NEAR(board().truth().x_m, 0.5, 0.005);
  received();
  send(protocol::Arm{}, 3);
  EXPECT_EQ(received().back().header.message_id, protocol::Ack::kId) << "the drive has ended";
}

TEST_F(Frames, ARefusedRequestDoesNotMakeItsSenderTheDriver) {
  send(protocol::Arm{}, 1);
  send(robot::line(5).front(), 2);
  for (int i = 0; i < 10; ++i) {
    send(protocol::Ping{}, static_cast<std::uint16_t>(10 + i));
    send(protocol::AddSegment{}, static_cast<std::uint16_t>(30 + i), 0);  // empty: out of range
    silence_ms(100);
  }
  EXPECT_EQ(drive().faults().mask(), 0U);
}

TEST_F(Frames, AnotherProtocolVersionIsToldOurs) {
  received();
  send(protocol::Hello{protocol::kProtocolVersion + 1}, 1);
  const auto answers = received();
  ASSERT_EQ(answers.size(), 1U);
  const auto reply = protocol::decode<protocol::ErrorReply>(answers[0].body);
  ASSERT_TRUE(reply.ok());
  EXPECT_EQ(reply->code, ErrorCode::wrong_version);
  EXPECT_EQ(reply->detail, protocol::kProtocolVersion);
}

TEST_F(Frames, MalformedAndUnknownRequestsAreNamedAndHarmless) {
  received();
  send_body({0x3F, 7, 0});        // no such request
  send_body({0x08, 8, 0, 1, 2});  // a Velocity cut short
  const auto answers = received();
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(error(answers[0]), ErrorCode::unknown_message);
  EXPECT_EQ(answers[0].header.request_id, 7);
  EXPECT_EQ(error(answers[1]), ErrorCode::malformed);
}

TEST_F(Frames, GarbageIsCountedAndDoesNotDisturb) {
  std::vector<std::uint8_t> garbage;
  for (int i = 0; i < 5000; ++i) garbage.push_back(static_cast<std::uint8_t>(i * 7 + i / 13));
  for (std::size_t at = 0; at < garbage.size(); at += 500) {
    send(std::span(garbage).subspan(at, 500));
    silence_ms(1);
  }
  send(std::vector<std::uint8_t>{0});
  received();
  send(protocol::Ping{}, 1);
  EXPECT_EQ(received().size(), 1U);
  EXPECT_GT(ask(protocol::GetStatus{}).rx_bad_frames, 0U);
}

TEST_F(Frames, TelemetryComesAtItsRateWithItsFields) {
  received();
  send(protocol::SetTelemetry{20, protocol::Telemetry::kCounts | protocol::Telemetry::kBattery}, 1);
  received();
  silence_ms(998);
  const auto answers = received();
  EXPECT_NEAR(static_cast<double>(answers.size()), 50, 1);
  for (const Answer& answer : answers) {
    const auto telemetry = protocol::decode<protocol::Telemetry>(answer.body);
    ASSERT_TRUE(telemetry.ok());
    EXPECT_EQ(telemetry->fields, protocol::Telemetry::kCounts | protocol::Telemetry::kBattery);
    EXPECT_GT(telemetry->battery.mv, 11'000);
  }
}

TEST_F(Frames, UnknownTelemetryFieldsAreRefused) {
  EXPECT_EQ(refusal(protocol::SetTelemetry{10, 1U << 20}).code(), ErrorCode::out_of_range);
}

TEST_F(Frames, AHostThatNeverReadsDoesNotHoldTheRobotUp) {
  send(protocol::SetTelemetry{1, protocol::Telemetry::kAll}, 1);
  silence_ms(5000);  // far more than the queue holds
  ask(protocol::Arm{});
  ask(robot::line(0.2).front());
  run_ms(3000);
  EXPECT_NEAR(board().truth().x_m, 0.2, 0.002);
}

TEST_F(Frames, TwoHostsAtTwoPortsAreAnsweredEach) {
  received();
  send(protocol::Ping{}, 5);
  const protocol::Pong pong = ask(protocol::Ping{});  // at port 0
  EXPECT_GT(pong.device_time_us, 0U);
  const auto answers = received();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].header.message_id, protocol::Pong::kId);
  EXPECT_EQ(answers[0].header.request_id, 5);
}

TEST_F(Frames, ARebootIsAnsweredBeforeItHappens) {
  received();
  send(protocol::Reboot{}, 1);
  const auto answers = received();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].header.message_id, protocol::Ack::kId);
  silence_ms(100);
  const auto events = received();
  ASSERT_FALSE(events.empty());
  const auto booted = protocol::decode<protocol::Booted>(events[0].body);
  ASSERT_TRUE(booted.ok());
  EXPECT_EQ(booted->reset_cause, protocol::ResetCause::software);
}

}  // namespace
}  // namespace astro
