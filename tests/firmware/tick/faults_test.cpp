#include <gtest/gtest.h>

#include <functional>

#include "common/fixed/wrapping.hpp"
#include "tests/support/robots/bench_robot.hpp"

// After a fault the outputs are off, the fault is latched under its name, and nothing re-arms by itself: faults by hosts, and
// what is special about the others. tests/scenario/fault_matrix_test.cpp provokes each fault in each state.
namespace astro {
namespace {

using protocol::ErrorCode;
using protocol::Mode;

class Faults : public support::RobotOnBench {
 protected:
  void drive_line() {
    ask(protocol::Arm{});
    ask(robot::line(5).front());
    run_ms(1000);
    ASSERT_TRUE(powered());
  }
  void expect_latched(Fault fault) {
    EXPECT_TRUE(open()) << "outputs are off";
    EXPECT_EQ(mode(), Mode::fault);
    EXPECT_EQ(drive().faults().first(), fault) << name(drive().faults().first());
    const robot::RobotRefused refused = refusal(protocol::Arm{});
    EXPECT_EQ(refused.code(), ErrorCode::faulted);
    EXPECT_EQ(refused.detail(), static_cast<std::uint16_t>(fault));
    silence_ms(2000);
    EXPECT_TRUE(open()) << "nothing re-arms by itself";
  }
};

TEST_F(Faults, ASegmentStopsWhenTheHostFallsSilent) {
  drive_line();
  silence_ms(210);  // 200 ms is the default command_timeout, which is checked every 8 ms
  EXPECT_EQ(mode(), Mode::stopping);
  silence_ms(1500);  // from 0.5 m/s at 0.5 m/s^2, until the wheels have stopped
  expect_latched(Fault::link_lost);
}

TEST_F(Faults, AVelocityStopsWhenItIsNotRepeated) {
  ask(protocol::Arm{});
  ask(protocol::Velocity{300'000, 0});
  run_ms(190);
  EXPECT_EQ(mode(), Mode::velocity);
  run_ms(50);  // the host is alive and pings, but nobody steers
  EXPECT_EQ(mode(), Mode::stopping);
  run_ms(1500);
  expect_latched(Fault::command_timeout);
}

TEST_F(Faults, ATimeoutOfZeroSwitchesTheTimeoutOff) {
  ask(protocol::RevertParameters{});
  ask(protocol::StageParameter{static_cast<std::uint16_t>(Param::command_timeout), 0, {}});
  ask(protocol::CommitParameters{});
  ask(protocol::Arm{});
  ask(protocol::Velocity{100'000, 0});
  silence_ms(5000);
  EXPECT_EQ(mode(), Mode::velocity);
}

TEST_F(Faults, DisarmingInTheRampOfAFaultIsAFaultToo) {
  drive_line();
  silence_ms(300);
  ASSERT_EQ(mode(), Mode::stopping);
  ask(protocol::Disarm{});
  expect_latched(Fault::link_lost);
}

TEST_F(Faults, EmergencyStopIsImmediateAndLatched) {
  drive_line();
  ask(protocol::EmergencyStop{});
  expect_latched(Fault::emergency_stop);
}

TEST_F(Faults, EmergencyStopWorksOnADisarmedRobotToo) {
  ask(protocol::EmergencyStop{});
  expect_latched(Fault::emergency_stop);
}

TEST_F(Faults, ASegmentThatWaitsInARampWhichAFaultEndsIsNeverDriven) {
  ask(protocol::Arm{});
  ask(protocol::Velocity{300'000, 0});
  run_ms(190);
  ask(protocol::Velocity{300'000, 0});
  run_ms(150);
  ask(robot::line(1).front());  // begins once the robot rests
  board().battery().set_open_circuit_V(9.0);
  ASSERT_EQ(mode(), Mode::stopping);
  run_ms(150);
  expect_latched(Fault::under_voltage);
  EXPECT_EQ(drive().queued(), 0U);
  board().battery().set_open_circuit_V(12.0);
  run_ms(200);
  ask(protocol::ClearFaults{});
  ask(protocol::Arm{});
  run_ms(500);
  EXPECT_EQ(mode(), Mode::idle) << "who clears and arms has asked for no drive";
}

TEST_F(Faults, AnEncoderThatJumpsIsNotBelieved) {
  drive_line();
  const std::int64_t x = drive().pose().x;
  const hal::EncoderCounts now = board().encoders().read();
  board().encoders().preset({now.left + 100'000, now.right});
  silence_ms(1);
  EXPECT_NEAR(static_cast<double>(drive().pose().x - x), 0, 0x1p40 * 0.001) << "the pose did not jump";
  silence_ms(1);
  expect_latched(Fault::encoder);
}

TEST_F(Faults, AReversedEncoderThatJumpsByHalfItsRangeIsNotBelieved) {
  ask(protocol::RevertParameters{});
  for (const Param polarity : {Param::motor_polarity_left, Param::encoder_polarity_left})
    ask(protocol::StageParameter{static_cast<std::uint16_t>(polarity), -1, {}});
  ask(protocol::CommitParameters{});
  drive_line();
  const hal::EncoderCounts now = board().encoders().read();
  board().encoders().preset(
      {wrapping_sum(now.left, INT32_MIN), now.right});  // of which the negative is itself
  silence_ms(2);
  expect_latched(Fault::encoder);
}

TEST_F(Faults, AreReportedAndClearedOnDemand) {
  std::vector<Fault> raised;
  const auto subscription = client_.on<protocol::FaultRaised>(
      [&](const protocol::FaultRaised& event) { raised.push_back(event.fault); });
  ask(protocol::EmergencyStop{});
  run_ms(20);
  EXPECT_EQ(raised, std::vector<Fault>{Fault::emergency_stop});
  const protocol::FaultReport report = ask(protocol::GetFaults{});
  EXPECT_EQ(report.first, Fault::emergency_stop);
  EXPECT_EQ(report.raised_count, 1U);
  ask(protocol::ClearFaults{});
  EXPECT_EQ(ask(protocol::GetFaults{}).latched, 0U);
  EXPECT_EQ(mode(), Mode::disarmed) << "cleared is not armed";
  ask(protocol::Arm{});
  EXPECT_EQ(mode(), Mode::idle);
}

TEST_F(Faults, EmergencyStopInEveryModeEndsWithOutputsOff) {
  const std::vector<std::function<void()>> ways{
      [&] {},
      [&] { ask(protocol::Arm{}); },
      [&] {
        ask(protocol::Arm{}), ask(protocol::Velocity{200'000, 500'000});
      },
      [&] { ask(protocol::Arm{}), ask(robot::line(3).front()); },
      [&] {
        ask(protocol::Arm{}), ask(protocol::Velocity{200'000, 0}), run_ms(150), ask(protocol::Stop{});
      },
  };
  for (std::size_t i = 0; i < ways.size(); ++i) {
    ways[i]();
    run_ms(150);
    ask(protocol::EmergencyStop{});
    EXPECT_TRUE(open()) << "way " << i;
    silence_ms(500);
    EXPECT_TRUE(open()) << "way " << i;
    ask(protocol::ClearFaults{});
  }
}

}  // namespace
}  // namespace astro
