#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/emulator/emulated_robot.hpp"
#include "host/link/client.hpp"

namespace astro::emulator {
namespace {

constexpr const char* kImage = ASTRO_IMAGE_DIR "/astrolabe-teensy40.hex";

TEST(Serial, TheRobotSaysWhoItIs) {
  auto robot = std::make_shared<EmulatedRobot>(kImage, sim::Config{}, simulator::MocapConfig{});
  link::Client client(std::make_unique<PortTransport>(robot, Port::serial));
  client.connect();
  const protocol::Status status = client.request(protocol::GetStatus{});
  fmt::print("battery {} mV, ticks {}, overruns {}\n", status.battery_mv, status.tick_count,
             status.tick_overruns);
  EXPECT_NEAR(status.battery_mv, 12'000, 50);
  EXPECT_EQ(status.reset_cause, protocol::ResetCause::power_on);
}

}  // namespace
}  // namespace astro::emulator
