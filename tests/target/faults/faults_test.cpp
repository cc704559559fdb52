#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>

#include "host/emulator/robot/emulated_robot.hpp"
#include "host/robot/client/client.hpp"
#include "tests/target/firmware_file.hpp"

namespace astro::emulator {
namespace {

using namespace std::chrono_literals;
using target::kImage;

constexpr std::uint32_t kSpare = 0x0001'F000;  // code memory behind the program
constexpr int kTick = 16 + 122;

/// The very image that is flashed, driving; then something happens to its processor that no test of the
/// source can bring about.
class RunningRobot : public testing::Test {
 protected:
  void SetUp() override {
    client_.connect();
    client_.request(protocol::Arm{});
    client_.request(protocol::Velocity{300'000, 0});
    teensy().run_for(100ms);
    ASSERT_FALSE(teensy().world().bridges().open[0]);
  }

  Teensy& teensy() { return robot_->teensy(); }
  Cpu& cpu() { return teensy().chip().cpu(); }
  int running() { return static_cast<int>(cpu().get(UC_ARM_REG_IPSR) & 0x1FF); }
  bool outputs_off() {
    const World::Bridges bridges = teensy().world().bridges();
    return bridges.open[0] && bridges.open[1];
  }

  /// Waits for a moment at which the processor runs this exception; 0 is the main loop.
  void wait_for(int exception) {
    ASSERT_TRUE(teensy().run_until([&] { return running() == exception; }, 20ms, 300ns));
  }
  /// The processor goes on with `code`.
  void derail(std::uint16_t code) {
    std::memcpy(teensy().chip().memory().at(kSpare, 2).data(), &code, 2);
    cpu().set(UC_ARM_REG_PC, kSpare | 1U);
    happened_at_ = teensy().now();
  }
  /// Until both bridges are open, ms.
  double off_after_ms() {
    EXPECT_TRUE(teensy().run_until([&] { return outputs_off(); }, 2s, 10us));
    return static_cast<double>(teensy().now() - happened_at_) / 600e3;
  }
  protocol::ResetCause cause_after_restart() {
    teensy().run_for(1s);
    EXPECT_TRUE(outputs_off()) << "nothing drives again by itself";
    robot::Client again(std::make_unique<PortTransport>(robot_, Port::serial));
    again.connect();
    const protocol::Status status = again.request(protocol::GetStatus{});
    using protocol::ResetCause;
    const bool by_itself =
        status.reset_cause == ResetCause::watchdog || status.reset_cause == ResetCause::fault;
    EXPECT_EQ(status.mode, by_itself ? protocol::Mode::fault : protocol::Mode::disarmed);
    EXPECT_EQ(status.latched_faults, by_itself ? bit(Fault::watchdog) : 0U);
    return status.reset_cause;
  }

  std::shared_ptr<EmulatedRobot> robot_ =
      std::make_shared<EmulatedRobot>(kImage, sim::Config{}, simulation::MocapConfig{});
  robot::Client client_{std::make_unique<PortTransport>(robot_, Port::serial)};
  Cycles happened_at_ = 0;
};

constexpr std::uint16_t kForEver = 0xE7FE, kUndefined = 0xDE00;  // b .   udf #0

TEST_F(RunningRobot, WithAHungMainLoopStopsAndIsRestartedByTheWatchdog) {
  wait_for(0);
  derail(kForEver);
  const double off_ms = off_after_ms();
  fmt::print("hung main loop: outputs off after {:.0f} ms\n", off_ms);
  EXPECT_LT(off_ms, 530);  // the watchdog's time, if the command timeout and its ramp do not come first
  EXPECT_EQ(cause_after_restart(), protocol::ResetCause::watchdog);
}

TEST_F(RunningRobot, WithAHungTickIsRestartedByTheWatchdog) {
  wait_for(kTick);
  derail(kForEver);
  const double off_ms = off_after_ms();
  fmt::print("hung tick: outputs off after {:.0f} ms\n", off_ms);
  EXPECT_LT(off_ms, 530);
  EXPECT_EQ(cause_after_restart(), protocol::ResetCause::watchdog);
}

TEST_F(RunningRobot, WithAnUndefinedInstructionOpensTheBridgesAtOnce) {
  wait_for(0);
  derail(kUndefined);
  EXPECT_LT(off_after_ms(), 0.05);
  EXPECT_EQ(cause_after_restart(), protocol::ResetCause::fault);
}

TEST_F(RunningRobot, WithAFaultInTheTickOpensTheBridgesAtOnce) {
  wait_for(kTick);
  derail(kUndefined);
  EXPECT_LT(off_after_ms(), 0.05);
  EXPECT_EQ(cause_after_restart(), protocol::ResetCause::fault);
}

TEST_F(RunningRobot, ThatJumpsToNowhereOpensTheBridgesAtOnce) {
  wait_for(0);
  cpu().set(UC_ARM_REG_PC, 0x9000'0001);
  happened_at_ = teensy().now();
  EXPECT_LT(off_after_ms(), 0.05);
  EXPECT_EQ(cause_after_restart(), protocol::ResetCause::fault);
}

TEST_F(RunningRobot, WithAStackThatOverflowsOpensTheBridgesAtOnce) {
  wait_for(0);
  cpu().set(UC_ARM_REG_SP, Memory::kDtcm + 8);  // the next push or interrupt goes below
  happened_at_ = teensy().now();
  EXPECT_LT(off_after_ms(), 1.1);  // within a tick
  EXPECT_EQ(cause_after_restart(), protocol::ResetCause::fault);
}

TEST_F(RunningRobot, ThatIsResetByItsButtonDrivesNoMore) {
  teensy().press_reset();
  happened_at_ = teensy().now();
  EXPECT_LT(off_after_ms(), 0.05);
  EXPECT_EQ(cause_after_restart(), protocol::ResetCause::pin);
}

TEST_F(RunningRobot, ThatRebootsOnRequestSaysSo) {
  client_.request(protocol::Disarm{});
  client_.request(protocol::Reboot{});
  teensy().run_for(100ms);
  EXPECT_EQ(cause_after_restart(), protocol::ResetCause::software);
}

TEST_F(RunningRobot, EntersTheBootloaderOnlyWhenDisarmedAndWithOutputsOff) {
  EXPECT_THROW(client_.request(protocol::EnterBootloader{}), robot::RobotRefused);
  client_.request(protocol::Disarm{});
  client_.request(protocol::EnterBootloader{});
  EXPECT_TRUE(teensy().run_until([&] { return teensy().in_bootloader(); }, 200ms));
  EXPECT_TRUE(outputs_off());
}

TEST_F(RunningRobot, EntersTheBootloaderWhateverIsSaidToItMeanwhile) {
  client_.request(protocol::Disarm{});
  client_.request(protocol::EnterBootloader{});
  const std::vector<std::uint8_t> words(50, 0x55);  // half a millisecond of the wire
  for (int ms = 0; ms < 200 && !teensy().in_bootloader(); ++ms) {
    teensy().serial().send(words);
    teensy().run_for(1ms);
  }
  EXPECT_TRUE(teensy().in_bootloader());
}

}  // namespace
}  // namespace astro::emulator
