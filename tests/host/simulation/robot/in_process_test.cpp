#include "host/simulation/robot/in_process.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/paths.hpp"

namespace astro::simulation {
namespace {

using std::chrono::milliseconds;

/// Keeps every byte that the robot sends.
class Recorded : public InProcessTransport {
 public:
  using InProcessTransport::InProcessTransport;
  std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override {
    const std::size_t size = InProcessTransport::read(into, timeout);
    bytes.insert(bytes.end(), into.begin(), into.begin() + static_cast<std::ptrdiff_t>(size));
    return size;
  }
  std::vector<std::uint8_t> bytes;
};

std::vector<std::uint8_t> bytes_of_a_drive(std::uint64_t seed) {
  sim::Config config;
  config.seed = seed;
  const auto robot = std::make_shared<VirtualRobot>(config, MocapConfig{.seed = seed});
  Recorded transport(robot);
  robot::Client client(transport);
  client.connect();
  client.request(protocol::SetTelemetry{10, protocol::Telemetry::kAll});
  robot::DriveSession drive(client);
  drive.run(robot::square(0.3, Sense::cw));
  return transport.bytes;
}

TEST(InProcess, TheSameSeedGivesTheSameBytes) { EXPECT_EQ(bytes_of_a_drive(7), bytes_of_a_drive(7)); }

TEST(InProcess, AnotherSeedGivesOtherBytes) { EXPECT_NE(bytes_of_a_drive(7), bytes_of_a_drive(8)); }

struct Rig {
  std::shared_ptr<VirtualRobot> robot = std::make_shared<VirtualRobot>(sim::Config(), MocapConfig());
  InProcessTransport transport{robot};
};

TEST(InProcess, OnlyWaitingMakesTimePass) {
  Rig rig;
  const auto start = rig.transport.now();
  std::array<std::uint8_t, 64> into{};
  rig.transport.read(into, milliseconds(0));
  EXPECT_EQ(rig.transport.now(), start);
  while (rig.transport.read(into, milliseconds(0)) > 0) {  // what the robot sent at its start
  }
  rig.transport.read(into, milliseconds(25));
  EXPECT_LE(rig.transport.now() - start, milliseconds(25));
  while (rig.transport.now() - start < milliseconds(25)) rig.transport.read(into, milliseconds(1));
}

TEST(InProcess, BytesThatNobodyReadsDoNotStopTheRobot) {
  Rig rig;
  robot::Client client(rig.transport);
  client.connect();
  client.request(protocol::SetTelemetry{1, protocol::Telemetry::kAll});
  for (int ms = 0; ms < 10'000; ++ms) rig.robot->step();  // 10 s of telemetry that is not read
  EXPECT_EQ(client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
}

TEST(InProcess, ARebootStartsTheClockAgainAndIsTold) {
  Rig rig;
  robot::Client client(rig.transport);
  client.connect();
  client.pump(milliseconds(500));
  const std::uint64_t before_us = client.request(protocol::Ping{}).device_time_us;
  bool booted = false;
  const auto subscription = client.on<protocol::Booted>(
      [&](const protocol::Booted& event) { booted = event.reset_cause == protocol::ResetCause::software; });
  client.request(protocol::Reboot{});
  EXPECT_TRUE(client.pump_until([&] { return booted; }, milliseconds(500)));
  client.connect();
  EXPECT_LT(client.request(protocol::Ping{}).device_time_us, before_us);
  EXPECT_GT(rig.transport.now().count(), static_cast<std::int64_t>(before_us));  // ours went on
}

TEST(InProcess, TheCamerasGoOnThroughAReboot) {
  Rig rig;
  CameraTruth truth(rig.robot);
  robot::Client client(rig.transport);
  client.connect();
  client.request(protocol::Reboot{});
  client.pump(milliseconds(1000));
  const auto samples = truth.poll();
  EXPECT_GT(samples.size(), 55U);  // 60 per second
  EXPECT_LT(samples.back().time_us, 1'000'000) << "stamped by the robot's clock, which began again";
}

TEST(InProcess, WhoNeverAsksTheCamerasFindsTheLastMinutes) {
  Rig rig;
  for (int ms = 0; ms < 200'000; ++ms) rig.robot->step();
  const auto samples = rig.robot->take_truth();
  EXPECT_GE(samples.size(), 3600U);  // a minute at 60 Hz
  EXPECT_LE(samples.size(), 7200U);  // but not more than two minutes
  EXPECT_GT(samples.back().time_us, 199'900'000);
}

}  // namespace
}  // namespace astro::simulation
