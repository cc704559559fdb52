#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& code) { return Program(code).stopped_by(); }

TEST(Control, AResetNeedsItsKey) {
  EXPECT_THAT(refusal("set SCB_AIRCR, 4"), HasSubstr("SCB AIRCR: written without its key"));
}

TEST(Control, SubprioritiesAreRefused) {
  EXPECT_THAT(refusal("set SCB_AIRCR, 0x05FA0300"), HasSubstr("SCB AIRCR: subpriorities are not modelled"));
}

TEST(Control, TheVectorTableIsAlignedToItsSize) {
  EXPECT_THAT(refusal("set SCB_VTOR, 0x20000200"),
              HasSubstr("SCB VTOR: a table of 176 entries must lie at a multiple of 1024"));
}

TEST(Control, ARegisterOfTheCoreThatIsNotModelledEndsTheRun) {
  EXPECT_THAT(refusal("get 0xE000EF34"), HasSubstr("0xE000EF34: read of a register that is not modelled"));
  EXPECT_THAT(refusal("set 0xE000EF34, 1"),
              HasSubstr("0xE000EF34: a write of a register that is not modelled"));
}

std::string region(const std::string& base, const std::string& attributes) {
  return refusal("set MPU_RNR, 0\n set MPU_RBAR, " + base + "\n set MPU_RASR, " + attributes);
}

TEST(Mpu, ARegionHasAtLeast32Bytes) {
  EXPECT_THAT(region("0x20200000", "0x03080007"), HasSubstr("MPU RASR: a region has at least 32 bytes"));
}

TEST(Mpu, ARegionBeginsAtAMultipleOfItsSize) {
  EXPECT_THAT(region("0x20200400", "0x03080017"),
              HasSubstr("MPU RASR: the region does not begin at a multiple of its size"));
}

TEST(Mpu, SubregionsAreRefused) {
  EXPECT_THAT(region("0x20200000", "0x03080125"), HasSubstr("MPU RASR: subregions are not modelled"));
}

TEST(Mpu, ASmallRegionIsThereToLetNobodyIn) {
  EXPECT_THAT(region("0x20200000", "0x03080009"),
              HasSubstr("MPU RASR: a region below 1 KB that gives some access is not modelled"));
  EXPECT_EQ(region("0x20200000", "0x10000009"), "");
}

TEST(Mpu, IsOffWhileItsRegionsAreProgrammed) {
  const std::string on = "set MPU_RNR, 0\n set MPU_RBAR, 0\n set MPU_RASR, 0x0308003F\n set MPU_CTRL, 5\n ";
  for (const char* write : {"set MPU_RBAR, 0x20200011", "set MPU_RASR, 0"})
    EXPECT_THAT(refusal(on + write), HasSubstr("MPU: a region is programmed while the MPU is on")) << write;
  EXPECT_EQ(refusal(on + "set MPU_CTRL, 0\n set MPU_RNR, 1\n set MPU_RBAR, 0x20200000"), "");
}

TEST(HandOver, LeavesWhatAProgramMustNotRelyOn) {
  const Program program("stay");
  Teensy teensy(program.hex(), {}, HandOver::untidy);
  Chip& chip = teensy.chip();
  EXPECT_TRUE(chip.protection().on());
  EXPECT_EQ(chip.cpu().get(UC_ARM_REG_CONTROL), 2U) << "the process stack";
  EXPECT_NE(chip.cpu().get(UC_ARM_REG_BASEPRI), 0U);
  EXPECT_EQ(chip.cpu().get(UC_ARM_REG_FAULTMASK), 1U);
  EXPECT_TRUE(chip.pending(exception::kSysTick));
  EXPECT_TRUE(chip.pending(exception::kPendSv));
}

TEST(HandOver, KillsAProgramThatReliesOnIt) {
  Program program("movs r0, #1\n keep 0");
  Teensy teensy(program.hex(), {}, HandOver::untidy);
  teensy.run_for(1ms);
  EXPECT_NE(teensy.word_at(Memory::kDtcm), 1U) << "no region of its own lets it write there";
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 1U);
}

}  // namespace
}  // namespace astro::emulator
