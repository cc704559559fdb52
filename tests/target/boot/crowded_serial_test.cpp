#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "host/emulator/robot/emulated_robot.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/motion/paths.hpp"
#include "tests/target/firmware_file.hpp"

// All telemetry every millisecond is more than the serial port of 1,000,000 baud takes.
namespace astro::emulator {
namespace {

using namespace std::chrono_literals;
using protocol::Telemetry;

TEST(CrowdedSerialPort, AnswersEveryRequestAndLosesNoEvent) {
  auto robot = std::make_shared<EmulatedRobot>(target::kImage, sim::Config{}, simulation::MocapConfig{});
  // A fault is written into the log, and nobody is answered while a sector is erased: not what this is about.
  robot->teensy().flash().times = {50 * kCyclesPerMicrosecond, 500 * kCyclesPerMicrosecond};
  robot::Client client(std::make_unique<PortTransport>(robot, Port::serial));
  client.connect();
  client.pump(50ms);
  const auto repeats = client.counts().repeats;  // the robot was not up yet when the first Hello came
  int samples = 0, faults = 0;
  std::vector<int> started, done;
  const auto on_sample = client.on<Telemetry>([&](const auto&) { ++samples; });
  const auto on_fault = client.on<protocol::FaultRaised>([&](const auto&) { ++faults; });
  const auto on_start =
      client.on<protocol::SegmentStarted>([&](const auto& one) { started.push_back(one.tag); });
  const auto on_done = client.on<protocol::SegmentDone>([&](const auto& one) { done.push_back(one.tag); });
  client.request(protocol::SetTelemetry{1, Telemetry::kAll});
  client.pump(100ms);
  ASSERT_GT(samples, 49) << "the line is full";  // 162 bytes each, of 100 a millisecond

  client.request(protocol::Arm{});
  constexpr int kSegments = 12;
  for (int tag = 1; tag <= kSegments; ++tag) {
    protocol::AddSegment segment = robot::line(0.01).front();
    segment.tag = static_cast<std::uint16_t>(tag);
    client.request(segment);
  }
  std::uint64_t longest_us = 0;
  const std::uint64_t begun = client.counts().requests;
  for (int i = 0; i < 1000 && done.size() < kSegments; ++i) {
    const auto asked = client.now();
    client.request(protocol::GetParameterInfo{static_cast<std::uint16_t>(i % 30)});  // the longest answers
    longest_us = std::max(longest_us, static_cast<std::uint64_t>((client.now() - asked).count()));
    client.request(protocol::Ping{});
    client.pump(10ms);
  }
  for (int i = 0; i < 10; ++i) {
    client.request(protocol::EmergencyStop{});
    client.pump(5ms);
    client.request(protocol::ClearFaults{});
  }
  client.pump(50ms);
  std::vector<int> tags(kSegments);
  std::iota(tags.begin(), tags.end(), 1);
  EXPECT_EQ(started, tags);
  EXPECT_EQ(done, tags);
  EXPECT_EQ(faults, 10);
  EXPECT_EQ(client.counts().missed_events, 0U);
  EXPECT_EQ(client.counts().repeats, repeats);
  EXPECT_EQ(client.counts().lost_pings, 0U);
  EXPECT_GT(client.counts().requests - begun, 200U);
  fmt::print("{} requests beside {} samples of telemetry: each answered, the slowest after {} us\n",
             client.counts().requests, samples, longest_us);
}

}  // namespace
}  // namespace astro::emulator
