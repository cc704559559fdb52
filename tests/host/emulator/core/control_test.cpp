#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

Remark refusal(const std::string& code) { return Program(code).fault(); }

TEST(Control, AResetNeedsItsKey) {
  EXPECT_THAT(refusal("set SCB_AIRCR, 4"), Tells(ControlProblem::reset_without_key));
}

TEST(Control, SubprioritiesAreRefused) {
  EXPECT_THAT(refusal("set SCB_AIRCR, 0x05FA0300"), Tells(ControlProblem::subpriorities));
}

TEST(Control, TheVectorTableIsAlignedToItsSize) {
  EXPECT_THAT(refusal("set SCB_VTOR, 0x20000200"), Tells(ControlProblem::vectors_misaligned));
}

TEST(Control, ARegisterOfTheCoreThatIsNotModelledEndsTheRun) {
  EXPECT_THAT(refusal("get 0xE000EF34"), Tells(AccessProblem::not_modelled, "0xE000EF34", "read"));
  EXPECT_THAT(refusal("set 0xE000EF34, 1"), Tells(AccessProblem::not_modelled, "0xE000EF34", "write"));
}

Remark region(const std::string& base, const std::string& attributes) {
  return refusal("set MPU_RNR, 0\n set MPU_RBAR, " + base + "\n set MPU_RASR, " + attributes);
}

TEST(Mpu, ARegionHasAtLeast32Bytes) {
  EXPECT_THAT(region("0x20200000", "0x03080007"), Tells(RegionProblem::too_small));
}

TEST(Mpu, ARegionBeginsAtAMultipleOfItsSize) {
  EXPECT_THAT(region("0x20200400", "0x03080017"), Tells(RegionProblem::misaligned));
}

TEST(Mpu, SubregionsAreRefused) {
  EXPECT_THAT(region("0x20200000", "0x03080125"), Tells(RegionProblem::subregions));
}

TEST(Mpu, ASmallRegionIsThereToLetNobodyIn) {
  EXPECT_THAT(region("0x20200000", "0x03080009"), Tells(RegionProblem::small_with_access));
  EXPECT_EQ(region("0x20200000", "0x10000009").sentence, "");
}

TEST(Mpu, IsOffWhileItsRegionsAreProgrammed) {
  const std::string on = "set MPU_RNR, 0\n set MPU_RBAR, 0\n set MPU_RASR, 0x0308003F\n set MPU_CTRL, 5\n ";
  for (const char* write : {"set MPU_RBAR, 0x20200011", "set MPU_RASR, 0"})
    EXPECT_THAT(refusal(on + write), Tells(RegionProblem::mpu_on)) << write;
  EXPECT_EQ(refusal(on + "set MPU_CTRL, 0\n set MPU_RNR, 1\n set MPU_RBAR, 0x20200000").sentence, "");
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
