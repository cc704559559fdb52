#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/robots/bench_robot.hpp"

namespace astro {
namespace {

using protocol::ErrorCode;
using protocol::Mode;

class Driving : public support::RobotOnBench {
 protected:
  void arm() { ask(protocol::Arm{}); }
  void add(const robot::Path& path, std::uint16_t first_tag = 1) {
    for (protocol::AddSegment segment : path) {
      segment.tag = first_tag++;
      ask(segment);
    }
  }
  /// Keeps the robot alive until it has come to rest; false after a minute.
  bool until_rest() {
    return client_.pump_until([&] { return mode() == Mode::idle && drive().queued() == 0; },
                              std::chrono::minutes(1));
  }
  double x_m() { return std::ldexp(static_cast<double>(drive().pose().x), -40); }
  double y_m() { return std::ldexp(static_cast<double>(drive().pose().y), -40); }
  double theta_rad() {
    return std::ldexp(static_cast<double>(static_cast<std::int64_t>(drive().pose().theta.raw())), -63) *
           std::numbers::pi;
  }
};

TEST_F(Driving, OutputsAreOffAtBootAndStayOffUntilArmed) {
  EXPECT_TRUE(open());
  EXPECT_EQ(refusal(protocol::Velocity{100'000, 0}).code(), ErrorCode::not_armed);
  EXPECT_EQ(refusal(robot::line(1).front()).code(), ErrorCode::not_armed);
  silence_ms(100);
  EXPECT_TRUE(open());
  EXPECT_EQ(mode(), Mode::disarmed);
}

TEST_F(Driving, AnArmedRobotAtRestDoesNotPowerItsMotors) {
  arm();
  silence_ms(1000);
  EXPECT_FALSE(powered());
  EXPECT_EQ(mode(), Mode::idle);
}

TEST_F(Driving, ACommandOfATenthOfAMetrePerSecondIsExactlyThat) {
  arm();
  for (int i = 0; i < 10; ++i) {
    ask(protocol::Velocity{100'000, 0});
    silence_ms(100);
  }
  EXPECT_EQ(drive().wheels().set_points(), (WheelSpeeds{100'000, 100'000})) << "no dither";
}

TEST_F(Driving, APureSpinHasEqualAndOppositeSetPoints) {
  arm();
  for (int i = 0; i < 10; ++i) {
    ask(protocol::Velocity{0, 1'000'000});
    silence_ms(100);
  }
  EXPECT_EQ(drive().wheels().set_points().left_umps, -drive().wheels().set_points().right_umps);
  EXPECT_EQ(drive().wheels().set_points().right_umps, 145'000);  // half of 0.290 m
}

TEST_F(Driving, ACommandBeyondTheLimitsKeepsItsCurvature) {
  arm();
  for (int i = 0; i < 30; ++i) {
    ask(protocol::Velocity{3'000'000, 1'000'000});  // 4 times the speed limit of 0.75 m/s
    silence_ms(100);
  }
  const WheelSpeeds set = drive().wheels().set_points();
  EXPECT_NEAR((set.left_umps + set.right_umps) / 2.0, 750'000, 1);
  EXPECT_NEAR((set.right_umps - set.left_umps) / 0.290, 250'000, 5);
}

TEST_F(Driving, StopRampsWithinTheAccelerationLimitAndStaysArmed) {
  arm();
  for (int i = 0; i < 10; ++i) {
    ask(protocol::Velocity{300'000, 0});
    silence_ms(100);
  }
  ask(protocol::Stop{});
  std::int32_t last = drive().wheels().set_points().left_umps;
  for (int i = 0; i < 2000 && mode() == Mode::stopping; ++i) {
    silence_ms(1);
    const std::int32_t now = drive().wheels().set_points().left_umps;
    EXPECT_LE(last - now, 500) << "0.5 m/s^2 is 500 um/s a tick";
    last = now;
  }
  EXPECT_EQ(mode(), Mode::idle);
}

TEST_F(Driving, ALineEndsWhereItShould) {
  arm();
  add(robot::line(1));
  ASSERT_TRUE(until_rest());
  EXPECT_NEAR(x_m(), 1, 0.001);  // settles within half a millimetre
  EXPECT_NEAR(y_m(), 0, 0.001);
}

TEST_F(Driving, AnArcTurnsByItsAngleAlongItsLength) {
  arm();
  add(robot::arc(0.5 * std::numbers::pi, 0.25));  // quarter circle of radius 1 m
  ASSERT_TRUE(until_rest());
  EXPECT_NEAR(x_m(), 1, 0.003);
  EXPECT_NEAR(y_m(), 1, 0.003);
  EXPECT_NEAR(theta_rad(), std::numbers::pi / 2, 0.003);
}

TEST_F(Driving, SegmentsEndInOrderUnderTheirTags) {
  std::vector<int> tags;
  const auto subscription = client_.on<protocol::SegmentDone>([&](const protocol::SegmentDone& done) {
    EXPECT_EQ(done.outcome, protocol::SegmentOutcome::completed);
    tags.push_back(done.tag);
  });
  arm();
  add(robot::square(0.2, Sense::cw), 11);
  ASSERT_TRUE(until_rest());
  run_ms(20);
  EXPECT_EQ(tags, (std::vector<int>{11, 12, 13, 14, 15, 16, 17, 18}));
}

TEST_F(Driving, StopAbortsTheQueueAndSaysSo) {
  int aborted = 0;
  const auto subscription = client_.on<protocol::SegmentDone>([&](const protocol::SegmentDone& done) {
    aborted += done.outcome == protocol::SegmentOutcome::aborted ? 1 : 0;
  });
  arm();
  add(robot::square(1, Sense::cw));
  run_ms(500);
  ask(protocol::Stop{});
  ASSERT_TRUE(until_rest());
  run_ms(20);
  EXPECT_EQ(aborted, 8);
}

TEST_F(Driving, TheQueueTakesSixteenBesidesTheOneUnderWay) {
  arm();
  add(robot::line(5));
  run_ms(10);
  protocol::AddSegment more = robot::line(0.1).front();
  for (int i = 0; i < 16; ++i) ask(more);
  EXPECT_EQ(refusal(more).code(), ErrorCode::queue_full);
}

TEST_F(Driving, RefusesSegmentsThatAreNone) {
  arm();
  EXPECT_EQ(refusal(protocol::AddSegment{}).code(), ErrorCode::out_of_range) << "empty";
  protocol::AddSegment bent = robot::line(1).front();
  bent.angle = 1 << 20;
  EXPECT_EQ(refusal(bent).code(), ErrorCode::out_of_range) << "a line does not turn";
  protocol::AddSegment backward_speed = robot::line(1).front();
  backward_speed.speed_umps = -1;
  EXPECT_EQ(refusal(backward_speed).code(), ErrorCode::out_of_range);
}

TEST_F(Driving, WhatNeedsRestIsRefusedWhileMoving) {
  arm();
  add(robot::line(1));
  run_ms(200);
  EXPECT_EQ(refusal(protocol::SetPose{}).code(), ErrorCode::moving);
  EXPECT_EQ(refusal(protocol::CommitParameters{}).code(), ErrorCode::moving);
  EXPECT_EQ(refusal(protocol::Reboot{}).code(), ErrorCode::moving);
  EXPECT_EQ(refusal(protocol::EnterBootloader{}).code(), ErrorCode::moving);
  EXPECT_EQ(refusal(protocol::ClearFaults{}).code(), ErrorCode::moving);
}

TEST_F(Driving, DisarmOpensTheBridgesAtOnce) {
  arm();
  add(robot::line(1));
  run_ms(500);
  ASSERT_TRUE(powered());
  ask(protocol::Disarm{});
  EXPECT_TRUE(open());
  EXPECT_EQ(mode(), Mode::disarmed);
}

TEST_F(Driving, SetPoseMovesTheOdometryAndNothingElse) {
  ask(protocol::SetPose{std::int64_t{3} << 40, -(std::int64_t{1} << 40), std::uint64_t{1} << 62});
  EXPECT_EQ(x_m(), 3);
  EXPECT_EQ(y_m(), -1);
  EXPECT_NEAR(theta_rad(), std::numbers::pi / 2, 1e-12);
}

/// Left motor and encoder reversed, and parameters that say so.
TEST(Wiring, PolarityParametersMakeForwardForward) {
  sim::Config config;
  config.slip_m = 0;
  config.wiring.left_motor_reversed = true;
  config.wiring.left_encoder_reversed = true;
  auto robot = std::make_shared<simulation::VirtualRobot>(config, simulation::MocapConfig{});
  robot::Client client(std::make_unique<simulation::InProcessTransport>(robot));
  client.connect();
  client.pump(std::chrono::milliseconds(50));  // through boot
  client.request(protocol::RevertParameters{});
  client.request(protocol::StageParameter{static_cast<std::uint16_t>(Param::motor_polarity_left), -1, {}});
  client.request(protocol::StageParameter{static_cast<std::uint16_t>(Param::encoder_polarity_left), -1, {}});
  client.request(protocol::CommitParameters{});
  client.request(protocol::Arm{});
  client.request(robot::line(0.5).front());
  client.pump(std::chrono::seconds(4));
  EXPECT_NEAR(robot->board().truth().x_m, 0.5, 0.002);
  EXPECT_NEAR(robot->board().truth().theta_rad, 0, 0.003);
}

TEST_F(Driving, WheelVoltagesReachTheMotorsWhateverTheSupplyIs) {
  ask(protocol::Arm{});
  for (const double supply_V : {11.0, 13.0}) {
    board().battery().set_open_circuit_V(supply_V);
    for (int i = 0; i < 10; ++i) {
      ask(protocol::WheelVoltage{3'000, -4'500});
      run_ms(50);
    }
    EXPECT_EQ(mode(), Mode::wheels);
    const double bus_V = board().drivetrain().bus_V();
    // One step of the duty is 0.4 mV; the reading of the supply has an error of 1 mV in 12 V.
    EXPECT_NEAR(board().motors().duty().left * bus_V / 32767, 3.0, 0.002);
    EXPECT_NEAR(board().motors().duty().right * bus_V / 32767, -4.5, 0.002);
  }
}

TEST_F(Driving, WheelVoltagesEndInABrakeOnStopAndWithAFaultWhenTheyAreNotRepeated) {
  EXPECT_EQ(refusal(protocol::WheelVoltage{3'000, 3'000}).code(), ErrorCode::not_armed);
  ask(protocol::Arm{});
  ask(protocol::WheelVoltage{3'000, 3'000});
  run_ms(100);
  ask(protocol::Rest{});
  run_ms(2);
  EXPECT_EQ(mode(), Mode::idle);
  EXPECT_EQ(board().motors().state(), Bridge::brake);
  ask(protocol::WheelVoltage{3'000, 3'000});
  run_ms(210);  // with pings
  EXPECT_EQ(drive().faults().mask(), bit(Fault::command_timeout));
  EXPECT_TRUE(open()) << "open loop there is no ramp to wait for";
}

TEST_F(Driving, WheelVoltagesAreRefusedWhileTheRobotDrives) {
  ask(protocol::Arm{});
  ask(protocol::Velocity{100'000, 0});
  run_ms(100);
  EXPECT_EQ(refusal(protocol::WheelVoltage{3'000, 3'000}).code(), ErrorCode::moving);
}

TEST_F(Driving, APauseStopsOnThePathAndResumeEndsItWhereItShould) {
  arm();
  add(robot::arc(1, 0.25 / std::numbers::pi));  // half a radian
  run_ms(1200);
  ask(protocol::Pause{});
  ASSERT_TRUE(client_.pump_until([&] { return mode() == Mode::paused; }, std::chrono::seconds(5)));
  const double paused_at_m = x_m();
  EXPECT_GT(paused_at_m, 0.1);
  EXPECT_LT(paused_at_m, 0.9);
  run_ms(3000);
  EXPECT_EQ(x_m(), paused_at_m) << "it does not creep";
  EXPECT_FALSE(powered());
  ask(protocol::Resume{});
  ASSERT_TRUE(until_rest());
  // A circle of radius 2 m: as if there had been no pause.
  EXPECT_NEAR(x_m(), 2 * std::sin(0.5), 0.001);
  EXPECT_NEAR(y_m(), 2 * (1 - std::cos(0.5)), 0.001);
  EXPECT_NEAR(theta_rad(), 0.5, 0.002);
}

TEST_F(Driving, APausedPathReportsItsSegmentDoneOnceAndItsStartTwice) {
  int started = 0, done = 0;
  const auto on_start = client_.on<protocol::SegmentStarted>([&](const auto&) { ++started; });
  const auto on_done = client_.on<protocol::SegmentDone>([&](const auto&) { ++done; });
  arm();
  add(robot::line(0.5));
  run_ms(500);
  ask(protocol::Pause{});
  run_ms(3000);
  ask(protocol::Resume{});
  ASSERT_TRUE(until_rest());
  run_ms(20);
  EXPECT_EQ(started, 2);
  EXPECT_EQ(done, 1);
}

TEST_F(Driving, PausedAgainAndAgainALineStillEndsToTheMillimetre) {
  arm();
  add(robot::line(1));
  for (int i = 0; i < 6; ++i) {
    run_ms(400);
    ask(protocol::Pause{});
    run_ms(1500);
    ask(protocol::Resume{});
  }
  ASSERT_TRUE(until_rest());
  EXPECT_NEAR(x_m(), 1, 0.001);
  EXPECT_NEAR(y_m(), 0, 0.001);
}

TEST_F(Driving, WhilePausedTheQueueFillsAndNothingMoves) {
  arm();
  ask(protocol::Pause{});
  add(robot::square(0.2, Sense::cw));
  run_ms(2000);
  EXPECT_EQ(mode(), Mode::paused);
  EXPECT_EQ(drive().queued(), 8U);
  EXPECT_EQ(x_m(), 0);
  ask(protocol::Resume{});
  ASSERT_TRUE(until_rest());
  EXPECT_NEAR(x_m(), 0, 0.001);
}

TEST_F(Driving, StopEndsAPausedPath) {
  arm();
  add(robot::line(1));
  run_ms(500);
  ask(protocol::Pause{});
  run_ms(2000);
  ask(protocol::Stop{});
  EXPECT_EQ(refusal(protocol::Resume{}).code(), ErrorCode::not_armed);
  run_ms(500);
  EXPECT_EQ(mode(), Mode::idle);
  EXPECT_EQ(drive().queued(), 0U);
}

TEST_F(Driving, ARobotThatIsCarriedAwayWhilePausedDoesNotRaceBack) {
  arm();
  add(robot::line(1));
  run_ms(500);
  ask(protocol::Pause{});
  run_ms(2000);
  const double here_m = x_m();
  ask(protocol::SetPose{std::int64_t{5} << 40, 0, 0});
  ask(protocol::Resume{});
  ASSERT_TRUE(until_rest());
  EXPECT_NEAR(x_m(), 5 + 1 - here_m, 0.002) << "the rest of the line, from where it stands";
}

TEST_F(Driving, APoseThatIsSetWhilePausedIsWhereThePathGoesOnHoweverNearItIs) {
  // 30 mm are within the range that the robot would otherwise take for its own error and correct.
  arm();
  add(robot::line(1));
  run_ms(500);
  ask(protocol::Pause{});
  run_ms(2000);
  ask(protocol::SetPose{drive().pose().x, (std::int64_t{3} << 40) / 100, 0});
  ask(protocol::Resume{});
  ASSERT_TRUE(until_rest());
  EXPECT_NEAR(x_m(), 1, 0.002);
  EXPECT_NEAR(y_m(), 0.03, 0.002) << "it goes straight on";
}

TEST_F(Driving, APauseEndsAVelocityAndNoOtherVelocityMovesTheRobotUntilItIsResumed) {
  arm();
  ask(protocol::Velocity{100'000, 0});
  run_ms(150);
  ask(protocol::Pause{});
  EXPECT_EQ(refusal(protocol::Velocity{100'000, 0}).code(), ErrorCode::not_armed);
  run_ms(1000);
  EXPECT_EQ(mode(), Mode::paused);
  ask(protocol::Resume{});
  run_ms(100);
  EXPECT_EQ(mode(), Mode::idle) << "there is no path to continue";
  ask(protocol::Velocity{100'000, 0});
  EXPECT_EQ(mode(), Mode::velocity);
}

TEST_F(Driving, ARobotThatWasPausedWithoutAPathIsReadyOnceItIsArmedAgain) {
  arm();
  for (const bool in_the_ramp : {false, true}) {
    const double from_m = x_m();
    if (in_the_ramp) ask(protocol::Velocity{100'000, 0}), run_ms(150);
    ask(protocol::Pause{});
    run_ms(10);
    ASSERT_EQ(mode(), in_the_ramp ? Mode::stopping : Mode::paused);
    arm();
    add(robot::line(0.1));
    EXPECT_TRUE(until_rest());
    EXPECT_NEAR(x_m(), from_m + 0.1, in_the_ramp ? 0.03 : 0.002);  // and the way of the velocity and its ramp
  }
}

TEST_F(Driving, ARestIsRefusedByARobotThatDoesNotDrive) {
  EXPECT_EQ(refusal(protocol::Rest{}).code(), ErrorCode::not_armed);
  arm();
  ask(protocol::Velocity{100'000, 0});
  silence_ms(2000);
  EXPECT_EQ(refusal(protocol::Rest{}).code(), ErrorCode::faulted);
}

TEST_F(Driving, ARestEndsAVelocityAndTheNextOneDrivesAgain) {
  arm();
  ask(protocol::Velocity{300'000, 0});
  run_ms(100);
  ask(protocol::Rest{});
  run_ms(2000);
  EXPECT_EQ(mode(), Mode::idle);
  ask(protocol::Velocity{300'000, 0});
  EXPECT_EQ(mode(), Mode::velocity);
}

TEST_F(Driving, AStopSegmentStandsForItsTime) {
  std::vector<std::pair<int, std::uint64_t>> done;
  const auto subscription = client_.on<protocol::SegmentDone>(
      [&](const protocol::SegmentDone& one) { done.emplace_back(one.tag, one.device_time_us); });
  arm();
  protocol::AddSegment stand{.kind = protocol::SegmentKind::stop};
  EXPECT_EQ(refusal(stand).code(), ErrorCode::out_of_range) << "for no time at all";
  stand.dwell_ms = 700;
  stand.tag = 2;
  add(robot::line(0.1));
  ask(stand);
  add(robot::line(0.1), 3);
  ASSERT_TRUE(until_rest());
  run_ms(20);
  ASSERT_EQ(done.size(), 3U);
  EXPECT_NEAR(static_cast<double>(done[1].second - done[0].second), 750'000, 5'000);  // and 50 ms to settle
  EXPECT_NEAR(x_m(), 0.2, 0.001);
}

TEST_F(Driving, TelemetryTellsHowThePathIsFollowed) {
  protocol::Telemetry last;
  double most = 0;
  const auto subscription = client_.on<protocol::Telemetry>([&](const protocol::Telemetry& one) {
    EXPECT_GE(one.path.progress / 32768.0, one.path.tag == last.path.tag ? last.path.progress / 32768.0 : 0);
    if (one.path.tag == 1) most = one.path.progress / 32768.0;
    last = one;
  });
  ask(protocol::SetTelemetry{5, protocol::Telemetry::kPath});
  arm();
  add(robot::line(0.3));
  add(robot::line(0.1), 2);
  run_ms(300);
  EXPECT_EQ(last.path.queued, 1);
  EXPECT_EQ(last.path.tag, 1);
  ASSERT_TRUE(until_rest());
  EXPECT_NEAR(most, 1, 0.001);
  EXPECT_LT(std::abs(last.path.cross_track_um), 1000);
}

TEST_F(Driving, ARobotThatIsTurnedWhilePausedDoesNotSpinBack) {
  arm();
  add(robot::line(1));
  run_ms(500);
  ask(protocol::Pause{});
  run_ms(2000);
  ask(protocol::SetPose{0, 0, std::uint64_t{1} << 62});  // a quarter turn
  ask(protocol::Resume{});
  run_ms(500);
  EXPECT_NEAR(theta_rad(), std::numbers::pi / 2, 0.01) << "it goes on ahead";
}

TEST_F(Driving, APausedStopStandsForTheRestOfItsTime) {
  int done = 0;
  const auto subscription = client_.on<protocol::SegmentDone>([&](const auto&) { ++done; });
  arm();
  ask(protocol::AddSegment{.kind = protocol::SegmentKind::stop, .tag = 1, .dwell_ms = 2000});
  run_ms(300);
  ask(protocol::Pause{});
  run_ms(3000);
  EXPECT_EQ(done, 0);
  ask(protocol::Resume{});
  run_ms(1500);
  EXPECT_EQ(done, 0);
  run_ms(500);
  EXPECT_EQ(done, 1);
}

TEST_F(Driving, VelocityAfterWheelVoltagesGoesOnFromTheSpeedThatIsThere) {
  arm();
  for (int i = 0; i < 15; ++i) {
    ask(protocol::WheelVoltage{6'000, 6'000});
    run_ms(100);
  }
  double least_mps = 1;
  for (int i = 0; i < 5; ++i) {
    ask(protocol::Velocity{400'000, 0});
    for (int ms = 0; ms < 100; ++ms) {
      silence_ms(1);
      least_mps = std::min(least_mps, board().drivetrain().speed_radps()[0] * 0.036);
    }
  }
  EXPECT_GT(least_mps, 0.35);
}

}  // namespace
}  // namespace astro
