#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "host/robot/client/client.hpp"
#include "host/simulation/robot/in_process.hpp"

// What a host sees of the gyro.
namespace astro {
namespace {

using namespace std::chrono_literals;
using protocol::Telemetry;

sim::Config desk_robot_with_gyro() {
  sim::Config config;
  config.gyro.emplace();
  return config;
}

struct GyroDesk {
  GyroDesk() {
    client.connect();
    client.pump(50ms);  // through boot
    heard = client.on<Telemetry>([this](const Telemetry& sample) { last = sample; });
    told = client.on<protocol::SlipFound>([this](const protocol::SlipFound& slip) { slips.push_back(slip); });
  }
  void use_gyro(std::int32_t axis) {
    client.request(protocol::RevertParameters{});  // opens the staging area
    client.request(protocol::StageParameter{static_cast<std::uint16_t>(Param::gyro_axis), axis, {}});
    client.request(protocol::CommitParameters{});
  }
  void kick(double turn_rad) {
    for (int i = 0; i < 100; ++i) {
      robot->board().kick(turn_rad / 100);
      client.pump(1ms);
    }
  }

  std::shared_ptr<simulation::VirtualRobot> robot =
      std::make_shared<simulation::VirtualRobot>(desk_robot_with_gyro(), simulation::MocapConfig{});
  robot::Client client{std::make_unique<simulation::InProcessTransport>(robot)};
  Telemetry last;
  std::vector<protocol::SlipFound> slips;
  robot::Subscription heard, told;
};

TEST(GyroAtTheLink, AHostGetsThePoseWithTheGyroBesideTheOdometryAndHearsOfSlips) {
  GyroDesk desk;
  desk.client.request(protocol::SetTelemetry{10, Telemetry::kPose | Telemetry::kFused});
  desk.use_gyro(3);
  desk.client.pump(2s);
  EXPECT_EQ(desk.last.fused.gyro, protocol::GyroState::running);
  EXPECT_EQ(desk.last.fused.temperature_cC, 2500);
  EXPECT_LE(desk.last.device_time_us - desk.last.fused.time_us, 10'000U);
  // The simulated bias of 0.02 rad/s, as half a second shows it: +- 6e-4 rad/s, of which four.
  EXPECT_NEAR(desk.last.fused.bias_uradps, 20'000, 2'500);

  const double turn_rad = 0.2;
  desk.kick(turn_rad);
  desk.client.pump(500ms);
  ASSERT_EQ(desk.slips.size(), 1U);
  EXPECT_GT(desk.slips[0].turn_100urad, 100) << "0.6 degrees or more";
  EXPECT_LE(desk.slips[0].turn_100urad, turn_rad * 1e4 * 1.1);
  EXPECT_EQ(desk.last.fused.slips, 1);
  EXPECT_EQ(desk.last.pose.theta, 0U) << "no wheel has turned";
  EXPECT_NEAR(
      static_cast<double>(static_cast<std::int64_t>(desk.last.fused.theta)) * 0x1p-64 * 2 * std::numbers::pi,
      turn_rad, 0.005);
}

TEST(GyroAtTheLink, WhereNoGyroIsUsedTheGroupIsTheOdometryAndSaysSo) {
  GyroDesk desk;
  desk.client.request(protocol::SetTelemetry{10, Telemetry::kPose | Telemetry::kFused});
  desk.client.request(protocol::Arm{});
  desk.client.request(protocol::Velocity{200'000, 500'000});
  desk.client.pump(150ms);
  EXPECT_EQ(desk.last.fused.gyro, protocol::GyroState::off);
  EXPECT_NE(desk.last.pose.theta, 0U);
  EXPECT_EQ(desk.last.fused.theta, desk.last.pose.theta);
  EXPECT_EQ(desk.last.fused.x, desk.last.pose.x);
  EXPECT_EQ(desk.last.fused.time_us, desk.last.device_time_us);
}

TEST(GyroAtTheLink, AGyroMountedUpsideDownIsToldByItsAxis) {
  GyroDesk desk;
  desk.client.request(protocol::SetTelemetry{10, Telemetry::kFused});
  desk.use_gyro(-3);
  desk.client.pump(2s);
  desk.kick(0.2);
  desk.client.pump(500ms);
  ASSERT_EQ(desk.slips.size(), 1U);
  EXPECT_LT(desk.slips[0].turn_100urad, 0);
}

}  // namespace
}  // namespace astro
