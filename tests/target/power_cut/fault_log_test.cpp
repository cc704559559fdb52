#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/safety/fault.hpp"
#include "host/emulator/robot/emulated_robot.hpp"
#include "host/robot/client/client.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/target/firmware_file.hpp"

// The very image that is flashed: its fault log outlives resets and power cuts.
namespace astro::emulator {
namespace {

using namespace std::chrono_literals;
using protocol::FaultLogEntry;
using target::kImage;

class FaultLog : public testing::Test {
 protected:
  void SetUp() override {
    flash().times = {50 * kCyclesPerMicrosecond, 500 * kCyclesPerMicrosecond};
    client_.connect();
  }
  Teensy& teensy() { return robot_->teensy(); }
  FlashChip& flash() { return teensy().flash(); }

  std::vector<FaultLogEntry> entries() {
    std::vector<FaultLogEntry> all;
    try {
      while (true)
        all.push_back(client_.request(protocol::GetFaultLog{static_cast<std::uint16_t>(all.size())}));
    } catch (const robot::RobotRefused& refused) {
      EXPECT_EQ(refused.code(), protocol::ErrorCode::out_of_range);
    }
    return all;
  }
  /// An emergency stop, and as long as the robot needs to write it down.
  void stop() {
    client_.request(protocol::EmergencyStop{});
    client_.pump(20ms);
  }

  std::shared_ptr<EmulatedRobot> robot_ =
      std::make_shared<EmulatedRobot>(kImage, sim::Config{}, simulation::MocapConfig{});
  robot::Client client_{std::make_unique<PortTransport>(robot_, Port::serial)};
};

TEST_F(FaultLog, OutlivesAResetAndAPowerCycle) {
  EXPECT_TRUE(entries().empty());
  client_.request(protocol::Arm{});
  client_.request(protocol::Velocity{300'000, 0});
  client_.pump(150ms);
  stop();
  client_.pump(2s);  // it rolls on
  ASSERT_EQ(entries().size(), 1U);
  teensy().press_reset();
  client_.connect();
  ASSERT_EQ(entries().size(), 1U);
  stop();
  teensy().power_cycle();
  client_.connect();
  const auto held = entries();
  ASSERT_EQ(held.size(), 2U);
  EXPECT_EQ(held[0].fault, static_cast<int>(Fault::emergency_stop));
  EXPECT_EQ(held[0].start, 2U);
  EXPECT_EQ(held[0].mode, static_cast<int>(protocol::Mode::disarmed));
  EXPECT_EQ(held[1].start, 1U);
  EXPECT_EQ(held[1].number, 1U);
  EXPECT_EQ(held[1].mode, static_cast<int>(protocol::Mode::velocity));
  EXPECT_GT(held[1].left_umps, 30'000);
  EXPECT_EQ(client_.request(protocol::GetStatus{}).latched_faults, 0U);
}

TEST_F(FaultLog, APowerCutWhileItIsWrittenLosesNoEntryBeforeIt) {
  stop();
  ASSERT_EQ(entries().size(), 1U);
  const auto parameters = flash().parameters();
  const std::vector<std::uint8_t> before(parameters.begin(), parameters.end());
  int cuts = 0, logged = 0;
  const auto step = static_cast<std::uint64_t>(support::how_often(5, 1));
  for (std::uint64_t cut = 0; cut <= 40; cut += step) {
    std::copy(before.begin(), before.end(), parameters.begin());
    teensy().power_cycle();
    client_.connect();
    flash().cut_power_after(cut, cut % 2 == 0 ? sim::Tear::torn : sim::Tear::byte);
    stop();
    ASSERT_FALSE(flash().powered());
    teensy().power_cycle();
    client_.connect();
    const auto held = entries();
    ASSERT_GE(held.size(), 1U) << "cut after " << cut;
    EXPECT_EQ(held.back().number, 1U);
    logged += held.size() == 2 ? 1 : 0;
    ++cuts;
  }
  fmt::print("{} cuts: {} times the entry under way was there too, never was one lost\n", cuts, logged);
  EXPECT_GE(logged, 1);
}

TEST_F(FaultLog, ASlowEraseDoesNotStarveTheWatchdog) {
  flash().times = FlashChip::Times::slowest();
  client_.request(protocol::EmergencyStop{});
  teensy().run_for(600ms);
  client_.connect();
  EXPECT_EQ(client_.request(protocol::GetStatus{}).reset_cause, protocol::ResetCause::power_on);
  EXPECT_EQ(entries().size(), 1U);
}

}  // namespace
}  // namespace astro::emulator
