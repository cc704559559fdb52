#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Bus, ARegisterThatIsNotModelledEndsTheRunWithItsAddressAndThePlace) {
  Program program("get 0x40084ABC");
  EXPECT_THAT(program.stopped_by(),
              AllOf(HasSubstr("0x40084ABC"), HasSubstr("not modelled"), HasSubstr("PC 0x6000")));
}

TEST(Bus, TheInstructionIsNamedAndNotTheBlockThatItIsIn) {
  Program program("b culprit\nculprit: ldr r6, =0x40084ABC\n nop\n nop\n ldr r0, [r6]");
  const std::string message = program.stopped_by();
  EXPECT_THAT(message, HasSubstr("culprit+0x6"));
}

TEST(Bus, AWriteToNothingEndsTheRun) {
  Program program("set 0x40200000, 1");
  EXPECT_THAT(program.stopped_by(), AllOf(HasSubstr("0x40200000"), HasSubstr("write")));
}

TEST(Bus, TheWrongWidthIsReportedByName) {
  Program program("set16 CCM_CACRR, 1");
  EXPECT_THAT(program.stopped_by(), HasSubstr("CCM CACRR: write of 2 bytes, the register has 4"));
}

TEST(Bus, A16BitRegisterIsNotWrittenByAWord) {
  Program program("set WDOG1_WMCR, 0");
  EXPECT_THAT(program.stopped_by(), HasSubstr("WDOG1 WMCR: write of 4 bytes, the register has 2"));
}

TEST(Bus, APeripheralWhoseClockIsOffIsReportedWithItsGate) {
  Program program("get PIT_MCR");
  EXPECT_THAT(program.stopped_by(),
              AllOf(HasSubstr("PIT MCR: read while its clock is off"), HasSubstr("CCGR1 CG6")));
}

TEST(Bus, TheFastPortsNeedNoClock) {
  Program program("set CCM_CCGR0, 0\n set CCM_CCGR1, 0\n get GPIO7_PSR\n keep 0");
  EXPECT_EQ(program.stopped_by(), "");
}

TEST(Bus, ABreakpointOtherThanTheBootLoadersEndsTheRun) {
  Program program("bkpt #0xAB");
  EXPECT_THAT(program.stopped_by(), HasSubstr("breakpoint"));
  EXPECT_FALSE(program.teensy().in_bootloader());
}

TEST(Bus, TheBootLoadersBreakpointIsAStateOfItsOwn) {
  Program program("movs r0, #7\n keep 0\n bkpt #251\n movs r0, #8\n keep 0");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_TRUE(program.teensy().in_bootloader());
  EXPECT_EQ(program.result(0), 7U);
}

}  // namespace
}  // namespace astro::emulator
