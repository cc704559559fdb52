#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "host/base/text/sense.hpp"
#include "host/emulator/robot/emulated_robot.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/robot/parameters/upload.hpp"
#include "tests/target/firmware_file.hpp"
#include "tests/target/tick/tick_profile.hpp"

namespace astro::target {
namespace {

using namespace std::chrono_literals;
using emulator::EmulatedRobot;

constexpr const char* kElf = ASTRO_IMAGE_DIR "/astrolabe-teensy40.elf";

class TickCost : public testing::Test {
 protected:
  TickCost() : TickCost(on_tyres()) {}
  explicit TickCost(const sim::Config& config)
      : robot_(std::make_shared<EmulatedRobot>(kImage, config, simulation::MocapConfig{})) {}
  void SetUp() override { client_.connect(); }

  /// Squares of lines and spins, and arcs.
  TickProfile::Cost expect_within(std::uint32_t bar) {
    TickProfile profile(robot_->teensy(), kElf);
    robot::DriveSession session(client_);
    for (const Sense sense : {Sense::cw, Sense::ccw}) session.run(robot::square(0.5, sense));
    for (int i = 0; i < 20; ++i) {
      session.set_velocity(0.4, 1.0);
      session.pump(50ms);
    }
    session.stop();
    profile.print(bar);
    EXPECT_GT(profile.ticks(), 10'000U);
    EXPECT_GT(profile.part(TickProfile::odometry).mean, 50) << "the odometry was not found in the image";
    EXPECT_GT(profile.part(TickProfile::safety).mean, 20) << "the supervisor was not found in the image";
    EXPECT_GT(profile.part(TickProfile::control).worst, 50U) << "the controller was not found in the image";
    EXPECT_LE(profile.budgeted().worst, bar);
    return profile.whole();
  }

  double odometry_heading_rad() {
    std::optional<protocol::Telemetry> newest;
    const auto subscription =
        client_.on<protocol::Telemetry>([&](const protocol::Telemetry& telemetry) { newest = telemetry; });
    client_.request(protocol::SetTelemetry{10, protocol::Telemetry::kPose});
    client_.pump_until([&] { return newest.has_value(); }, 1s);
    const auto& pose = newest.value().pose;
    return 2 * std::numbers::pi * (pose.turns + std::ldexp(static_cast<double>(pose.theta), -64));
  }

  static sim::Config on_tyres() {
    sim::Config config;
    config.true_e = kE;
    config.slip_m = 0;
    return config;
  }

  static constexpr double kE = 0.03;
  std::shared_ptr<EmulatedRobot> robot_;
  robot::Client client_{std::make_unique<emulator::PortTransport>(robot_, emulator::Port::serial)};
};

TEST_F(TickCost, OfControlOdometryAndSafetyIsWithin350Instructions) { expect_within(350); }

// Two divisions more, each with what brings its numbers to their best scale.
TEST_F(TickCost, WithACurvatureEffectIsWithin400Instructions) {
  robot::upload(client_, {{"e", kE}});
  expect_within(400);
  client_.pump(2s);  // to rest
  // A count of a wheel is 0.28 mrad, and the delay of the observed speeds a little less. Without e in the parameters the arc,
  // of 1 rad with g = 0.14, would be 4 mrad wrong.
  EXPECT_NEAR(odometry_heading_rad(), robot_->teensy().world().truth().theta_rad, 0.5e-3);
}

class TickCostWithGyro : public TickCost {
 protected:
  TickCostWithGyro() : TickCost(with_gyro()) {}

  static sim::Config with_gyro() {
    sim::Config config = on_tyres();
    config.gyro.emplace();
    return config;
  }
};

TEST_F(TickCostWithGyro, AWholeTickIsWithin1020InstructionsOnAverageAnd1300AtMost) {
  robot::upload(client_, {{"gyro_axis", 3.0}});
  client_.pump(1500ms);  // until the bias is known
  const TickProfile::Cost whole = expect_within(350);
  EXPECT_LE(whole.mean, 1020);
  EXPECT_LE(whole.worst, 1300U);
}

TEST_F(TickCost, TheFirstTickComesWithin50Milliseconds) {
  emulator::Teensy teensy(kImage);
  ASSERT_TRUE(teensy.run_until([&] { return (teensy.chip().cpu().get(UC_ARM_REG_IPSR) & 0x1FF) == 16 + 122; },
                               100ms, 400ns));
  const double ms = static_cast<double>(teensy.now()) / 600e3;
  fmt::print("first tick after {:.2f} ms\n", ms);
  EXPECT_LE(ms, 50);
}

}  // namespace
}  // namespace astro::target
