#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/emulator/robot/emulated_robot.hpp"
#include "host/robot/client/client.hpp"
#include "tests/target/firmware_file.hpp"

namespace astro::emulator {
namespace {

using target::kImage;

class RobotAt : public testing::TestWithParam<Port> {};
INSTANTIATE_TEST_SUITE_P(BothPorts, RobotAt, testing::Values(Port::serial, Port::usb), [](const auto& port) {
  return std::string(port.param == Port::usb ? "Usb" : "Serial");
});

TEST_P(RobotAt, SaysWhoItIs) {
  auto robot = std::make_shared<EmulatedRobot>(kImage, sim::Config{}, simulation::MocapConfig{});
  robot::Client client(std::make_unique<PortTransport>(robot, GetParam()));
  client.connect();
  const protocol::Status status = client.request(protocol::GetStatus{});
  fmt::print("battery {} mV, ticks {}, overruns {}\n", status.battery_mv, status.tick_count,
             status.tick_overruns);
  EXPECT_NEAR(status.battery_mv, 12'000, 50);
  EXPECT_EQ(status.reset_cause, protocol::ResetCause::power_on);
}

/// On a bus that others use, a read of a register takes so long that a character comes, and the line falls
/// silent, within the handler of the character before.
TEST(SerialPort, FindsACharacterThatComesWhileTheOneBeforeIsTaken) {
  auto robot = std::make_shared<EmulatedRobot>(kImage, sim::Config{}, simulation::MocapConfig{});
  Teensy& teensy = robot->teensy();
  teensy.run_for(std::chrono::milliseconds(50));
  teensy.serial().read_takes = 15 * kCyclesPerMicrosecond;
  for (int us = 0; us < 80; ++us) {
    SCOPED_TRACE(us);
    teensy.serial().send(std::array<std::uint8_t, 1>{0});  // ends a frame without content
    teensy.run_for(std::chrono::microseconds(10 + us));
    teensy.serial().send(std::array<std::uint8_t, 1>{0});
    ASSERT_NO_THROW(teensy.run_for(std::chrono::milliseconds(3)));
  }
}

TEST(Teensy, WithTheSameImageAndRobotGoesTheSameWayAndWithAnotherRobotItsOwn) {
  const auto state_after_50_ms = [](std::uint64_t seed) {
    sim::Config robot;
    robot.seed = seed;
    Teensy teensy(kImage, robot);
    teensy.run_for(std::chrono::milliseconds(50));
    return teensy.state_hash();
  };
  EXPECT_EQ(state_after_50_ms(1), state_after_50_ms(1));
  EXPECT_NE(state_after_50_ms(1), state_after_50_ms(2))
      << "another unique id, which the firmware keeps in RAM";
}

}  // namespace
}  // namespace astro::emulator
