#include <gtest/gtest.h>

#include <cstring>

#include "hal/teensy40/arithmetic/reset_cause.hpp"
#include "hal/teensy40/pins.hpp"
#include "host/emulator/teensy.hpp"
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
