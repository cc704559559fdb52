#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "host/emulator/robot/emulated_robot.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/parameters/upload.hpp"
#include "tests/target/firmware_file.hpp"

// The image that is flashed, with a gyro chip at its I2C bus, and what happens when that bus or chip fails.
namespace astro::emulator {
namespace {

using namespace std::chrono_literals;
using protocol::GyroState;
using target::kImage;

sim::Config with_gyro() {
  sim::Config config;
  config.gyro.emplace();
  config.slip_m = 0;
  return config;
}

class RobotWithGyro : public testing::Test {
 protected:
  void SetUp() override {
    client_.connect();
    robot::upload(client_, {{"gyro_axis", 3.0}});
    client_.request(protocol::SetTelemetry{10, protocol::Telemetry::kFused | protocol::Telemetry::kPose});
    subscription_ = client_.on<protocol::Telemetry>(
        [this](const protocol::Telemetry& telemetry) { newest_ = telemetry; });
    begin_ticks();
  }

  Teensy& teensy() { return robot_->teensy(); }
  /// Time goes by while the host keeps the robot driving.
  void drive_for(std::chrono::milliseconds time) {
    for (std::chrono::milliseconds left = time; left > 0ms; left -= 50ms) {
      client_.request(protocol::Velocity{200'000, 500'000});
      client_.pump(50ms);
    }
  }
  void drive() {
    client_.request(protocol::Arm{});
    drive_for(500ms);
  }
  GyroState gyro() { return newest_.value().fused.gyro; }
  bool becomes(GyroState state, std::chrono::milliseconds limit) {
    return client_.pump_until([&] { return newest_ && gyro() == state; }, limit);
  }
  double turn_rad(std::uint64_t theta, std::int32_t turns) {
    return 2 * std::numbers::pi * (turns + std::ldexp(static_cast<double>(theta), -64));
  }
  /// The heading by wheels and gyro minus that of the wheels.
  double correction_rad() {
    const auto& [pose, fused] = std::pair{newest_.value().pose, newest_.value().fused};
    return turn_rad(fused.theta, fused.turns) - turn_rad(pose.theta, pose.turns);
  }
  void begin_ticks() { overruns_ = client_.request(protocol::GetStatus{}).tick_overruns; }
  void expect_ticks_on_time() {
    const protocol::Status status = client_.request(protocol::GetStatus{});
    EXPECT_EQ(status.tick_overruns, overruns_);
    EXPECT_EQ(status.latched_faults, 0U);
    EXPECT_NE(status.mode, protocol::Mode::fault);
  }
  /// The fault begins in a robot that drives; `says` is what telemetry names it.
  void expect_survives(SensorFault fault, std::initializer_list<GyroState> says);

  std::shared_ptr<EmulatedRobot> robot_ =
      std::make_shared<EmulatedRobot>(kImage, with_gyro(), simulation::MocapConfig{});
  robot::Client client_{std::make_unique<PortTransport>(robot_, Port::serial)};
  std::optional<protocol::Telemetry> newest_;
  robot::Subscription subscription_;
  std::uint32_t overruns_ = 0;
};

TEST_F(RobotWithGyro, LearnsItsBiasAndFollowsAKickThatNoWheelSees) {
  ASSERT_TRUE(becomes(GyroState::running, 2s));
  client_.pump(1s);
  const double before_rad = correction_rad(), bias_radps = 1e-6 * newest_->fused.bias_uradps;
  EXPECT_NEAR(bias_radps, sim::GyroConfig{}.bias_radps, 0.003)
      << "noise of 0.025 degrees per root second, in half a second";
  constexpr double kKick_radps = 1.5;
  teensy().world().turn_body(kKick_radps);
  client_.pump(200ms);
  teensy().world().turn_body(0);
  client_.pump(100ms);
  // The integral of noise and bias over 0.3 s; a tick more or less of the kick.
  EXPECT_NEAR(correction_rad() - before_rad, 0.2 * kKick_radps, 0.004);
  EXPECT_EQ(newest_->fused.slips, 1);
  expect_ticks_on_time();
}

TEST_F(RobotWithGyro, DrivesOnItsWheelsWhenTheChipIsUnpluggedAndTakesItBack) {
  ASSERT_TRUE(becomes(GyroState::running, 2s));
  drive();
  teensy().gyro()->fault = SensorFault::unplugged;
  drive_for(500ms);
  EXPECT_EQ(gyro(), GyroState::failed);
  teensy().gyro()->fault = SensorFault::none;
  drive_for(2500ms);
  EXPECT_EQ(gyro(), GyroState::running) << "the bias is known already";
  expect_ticks_on_time();
}

void RobotWithGyro::expect_survives(SensorFault fault, std::initializer_list<GyroState> says) {
  ASSERT_TRUE(becomes(GyroState::running, 2s));
  drive();
  teensy().gyro()->fault = fault;
  if (fault == SensorFault::wrong_id) teensy().gyro()->power_on();  // the identity is asked for at a start
  std::set<GyroState> said;
  for (int i = 0; i < 60; ++i) {
    drive_for(50ms);
    said.insert(gyro());
  }
  for (const GyroState state : says) EXPECT_TRUE(said.contains(state)) << protocol::name(state);
  EXPECT_FALSE(newest_.value().fused.gyro == GyroState::running) << "nothing has been mended";
  EXPECT_EQ(newest_->fused.slips, 0) << "a fault is no slip";
  teensy().gyro()->fault = SensorFault::none;
  drive_for(2500ms);
  EXPECT_EQ(gyro(), GyroState::running);
  expect_ticks_on_time();
}

TEST_F(RobotWithGyro, SurvivesAnotherChipInThePlaceOfItsOwn) {
  expect_survives(SensorFault::wrong_id, {GyroState::failed});
}

TEST_F(RobotWithGyro, TellsAChipThatRepeatsItselfAndStartsItAgain) {
  expect_survives(SensorFault::frozen, {GyroState::frozen, GyroState::failed});
}

TEST_F(RobotWithGyro, TakesNoHalfOfASample) {
  expect_survives(SensorFault::half_sample, {GyroState::failed});
}

TEST_F(RobotWithGyro, SurvivesAClockThatIsHeldLow) {
  ASSERT_TRUE(becomes(GyroState::running, 2s));
  drive();
  teensy().i2c().hold_clock(true);
  drive_for(1500ms);
  EXPECT_EQ(gyro(), GyroState::failed);
  teensy().i2c().hold_clock(false);
  drive_for(2500ms);
  EXPECT_EQ(gyro(), GyroState::running);
  expect_ticks_on_time();
}

TEST_F(RobotWithGyro, FreesADataLineThatAChipHoldsInTheMiddleOfAByte) {
  ASSERT_TRUE(becomes(GyroState::running, 2s));
  drive();
  teensy().i2c().hold_data(7);
  drive_for(3s);
  EXPECT_FALSE(teensy().i2c().data_held()) << "nobody has clocked it free";
  EXPECT_EQ(gyro(), GyroState::running);
  expect_ticks_on_time();
}

TEST_F(RobotWithGyro, RestartsInTheMiddleOfAByteAndFreesTheLine) {
  ASSERT_TRUE(becomes(GyroState::running, 2s));
  teensy().press_reset();
  teensy().i2c().hold_data(5);
  client_.connect();
  client_.request(protocol::SetTelemetry{10, protocol::Telemetry::kFused | protocol::Telemetry::kPose});
  newest_.reset();
  EXPECT_TRUE(becomes(GyroState::running, 4s));
}

TEST(RobotWithoutGyro, AsksForOneOnceASecondAndDrives) {
  auto robot = std::make_shared<EmulatedRobot>(kImage, sim::Config{}, simulation::MocapConfig{});
  robot::Client client(std::make_unique<PortTransport>(robot, Port::serial));
  client.connect();
  std::optional<protocol::Telemetry> newest;
  const auto subscription =
      client.on<protocol::Telemetry>([&](const protocol::Telemetry& telemetry) { newest = telemetry; });
  robot::upload(client, {{"gyro_axis", 3.0}});
  client.request(protocol::SetTelemetry{10, protocol::Telemetry::kFused});
  const std::uint32_t starts = robot->teensy().i2c().starts();
  client.pump(10s);
  EXPECT_EQ(newest.value().fused.gyro, GyroState::absent);
  // Six addresses in each second.
  EXPECT_NEAR(robot->teensy().i2c().starts() - starts, 60, 7);
  EXPECT_EQ(client.request(protocol::GetStatus{}).tick_overruns, 0U);
}

}  // namespace
}  // namespace astro::emulator
