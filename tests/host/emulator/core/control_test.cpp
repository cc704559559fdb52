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
              HasSubstr("0xE000EF34: write of a register that is not modelled"));
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

}  // namespace
}  // namespace astro::emulator
