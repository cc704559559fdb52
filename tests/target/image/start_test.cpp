#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "hal/teensy40/arithmetic/reset_cause.hpp"
#include "hal/teensy40/pins.hpp"
#include "host/emulator/robot/teensy.hpp"
#include "tests/target/image/hex_file.hpp"

namespace astro::target {
namespace {

using namespace std::chrono_literals;
using namespace teensy40;

constexpr std::uint32_t kOutputs = gpio7::kDirections | gpio7::kLeftPwm | gpio7::kRightPwm;
constexpr std::uint32_t kSpare = 0x0001'F000;  // code memory behind the program
constexpr std::uint32_t kMemManage = 4, kUsageFault = 6;

/// The smallest image in the emulator: what boot does, without a robot on top.
class Start : public testing::Test {
 protected:
  std::uint32_t read(Register<std::uint32_t> at) { return teensy_.chip().bus().read(at.address(), 4); }
  std::uint32_t fault_status() { return teensy_.chip().fault_status(); }
  bool led() { return (teensy_.gpio7().driven() & gpio7::kLed) != 0; }

  emulator::Teensy teensy_{image("hex", "blink")};
};

TEST_F(Start, HoldsTheMotorDriversInputsLowFromTheFirstInstructions) {
  teensy_.run_for(100ns);
  EXPECT_EQ(teensy_.gpio7().outputs() & kOutputs, kOutputs);
  EXPECT_EQ(teensy_.gpio7().driven() & kOutputs, 0U);
}

TEST_F(Start, LeadsToAProgramThatChangesTheLedEveryMillisecond) {
  teensy_.run_for(5ms);
  for (int ms = 0; ms < 100; ++ms) {
    const bool before = led();
    teensy_.run_for(1ms);
    ASSERT_NE(led(), before) << "after " << ms << " ms";
  }
}

TEST_F(Start, LeavesASleepInWhichNothingButTheCoreStops) {
  constexpr std::uint32_t kAfterReset = 0x79;  // wait mode
  teensy_.chip().bus().write(CCM[ccm::CLPCR].address(), kAfterReset, 4);
  teensy_.run_for(5ms);
  EXPECT_EQ(ccm::CLPCR_LPM.of(read(CCM[ccm::CLPCR])), 0U);
  EXPECT_EQ(iomuxc_gpr::GPR1_CM7_FORCE_HCLK_EN.of(read(IOMUXC_GPR[iomuxc_gpr::GPR1])), 1U);
}

TEST_F(Start, LetsNothingRunButCodeMemoryAndTheRom) {
  teensy_.run_for(5ms);
  ASSERT_TRUE(teensy_.chip().protection().on());
  for (std::size_t number = 0; number < 16; ++number) {
    const auto region = teensy_.chip().protection().region(number);
    if (mpu::RASR_ENABLE.of(region.attributes) == 0 || mpu::RASR_XN.of(region.attributes) != 0) continue;
    EXPECT_TRUE(region.base == 0 || region.base == 0x0020'0000) << std::hex << region.base;
    EXPECT_EQ(mpu::RASR_AP.of(region.attributes), 7U) << std::hex << region.base << " can be written";
  }
}

TEST_F(Start, LeavesNothingOfWhatTheRomHasLeftBehind) {
  teensy_.run_for(5ms);
  emulator::Cpu& cpu = teensy_.chip().cpu();
  EXPECT_EQ(cpu.get(UC_ARM_REG_CONTROL), 0U) << "the main stack";
  for (const int mask : {UC_ARM_REG_PRIMASK, UC_ARM_REG_BASEPRI, UC_ARM_REG_FAULTMASK})
    EXPECT_EQ(cpu.get(mask), 0U);
  EXPECT_FALSE(teensy_.chip().pending(emulator::exception::kSysTick));
  EXPECT_FALSE(teensy_.chip().pending(emulator::exception::kPendSv));
  for (std::size_t number = 8; number < 16; ++number)
    EXPECT_EQ(mpu::RASR_ENABLE.of(teensy_.chip().protection().region(number).attributes), 0U) << number;
  EXPECT_EQ(fault_status(), 0U) << "a fault that is not this program's";
}

TEST_F(Start, AFaultLeavesItsKindAndPlaceAndBeginsAnew) {
  teensy_.run_for(5ms);
  constexpr std::uint16_t kUndefined = 0xDE00;  // udf #0
  std::memcpy(teensy_.chip().memory().at(kSpare, 2).data(), &kUndefined, 2);
  teensy_.chip().cpu().set(UC_ARM_REG_PC, kSpare | 1U);
  teensy_.run_for(10ms);
  EXPECT_EQ(read(SRC[src::GPR5]), marker::kFault);
  EXPECT_EQ(read(SRC[src::GPR6]), kUsageFault);
  EXPECT_EQ(read(SRC[src::GPR7]), kSpare);
  const bool before = led();
  teensy_.run_for(1ms);
  EXPECT_NE(led(), before);
}

/// Machine code that switches the MPU off, makes the 32 bytes at r1 nobody's, switches it on, and faults.
constexpr std::array<std::uint16_t, 12> kDenyAndFault{
    0x2300, 0x6043,  // movs r3, #0; str r3, [r0, #4]: CTRL
    0x230F, 0x6083,  // movs r3, #15; str r3, [r0, #8]: RNR
    0x60C1, 0x6102,  // str r1, [r0, #12]: RBAR; str r2, [r0, #16]: RASR
    0x2301, 0x6043,  // movs r3, #1; str r3, [r0, #4]
    0xF3BF, 0x8F4F,  // dsb
    0xDE00, 0xDE00   // udf #0
};

TEST_F(Start, AFaultWhoseFrameDidNotGetOntoTheStackLeavesItsKindAndNoPlace) {
  teensy_.run_for(5ms);
  std::memcpy(teensy_.chip().memory().at(kSpare, sizeof kDenyAndFault).data(), kDenyAndFault.data(),
              sizeof kDenyAndFault);
  // The frame of 32 bytes begins in the last 8 of those that nobody may touch: what lies at the place of its
  // program counter can be read, and is something else.
  constexpr std::uint32_t kDenied = emulator::Memory::kDtcm + 0x400, kFrame = kDenied + 24;
  std::memset(teensy_.chip().memory().at(kDenied, 64).data(), 0x5A, 64);
  emulator::Cpu& cpu = teensy_.chip().cpu();
  cpu.set(UC_ARM_REG_R0, MPU.base);
  cpu.set(UC_ARM_REG_R1, kDenied);
  cpu.set(UC_ARM_REG_R2, mpu::RASR_SIZE(4) | mpu::RASR_ENABLE(1));
  cpu.set(UC_ARM_REG_SP, kFrame + 32);
  cpu.set(UC_ARM_REG_PC, kSpare | 1U);
  teensy_.run_for(10ms);
  EXPECT_EQ(read(SRC[src::GPR5]), marker::kFault);
  EXPECT_EQ(read(SRC[src::GPR6]), kMemManage);
  EXPECT_EQ(read(SRC[src::GPR7]), 0U) << "what was on the stack before";
  EXPECT_NE(read(SRC[src::GPR8]) & 1U << 4, 0U) << "MSTKERR";
}

TEST_F(Start, AStackThatIsUsedUpLeavesItsKindAndBeginsAnew) {
  teensy_.run_for(5ms);
  teensy_.chip().cpu().set(UC_ARM_REG_SP, emulator::Memory::kDtcm + 8);
  teensy_.run_for(10ms);
  EXPECT_EQ(read(SRC[src::GPR5]), marker::kFault);
  EXPECT_EQ(read(SRC[src::GPR6]), kMemManage);
  EXPECT_EQ(read(SRC[src::GPR7]), 0U) << "there is no frame to read it from";
  const bool before = led();
  teensy_.run_for(1ms);
  EXPECT_NE(led(), before);
}

}  // namespace
}  // namespace astro::target
