#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

TEST(Bus, ARegisterThatIsNotModelledEndsTheRunWithItsAddressAndThePlace) {
  Program program("get 0x40084ABC");
  const auto run = [&] { program.teensy().run_for(1ms); };
  EXPECT_THAT(run, support::ThrowsTelling(AccessProblem::not_modelled, "0x40084ABC", "read"));
  const auto is_in_flash = [](const Stopped& stopped) { return stopped.pc() >> 16; };
  EXPECT_THAT(run, testing::Throws<Stopped>(testing::ResultOf(is_in_flash, 0x6000U)));
}

TEST(Bus, TheInstructionIsNamedAndNotTheBlockThatItIsIn) {
  Program program("b culprit\nculprit: ldr r6, =0x40084ABC\n nop\n nop\n ldr r0, [r6]");
  EXPECT_THAT([&] { program.teensy().run_for(1ms); },
              testing::Throws<Stopped>(testing::Property(&Stopped::function, "culprit+0x6")));
}

TEST(Bus, AWriteToNothingEndsTheRun) {
  Program program("set 0x40200000, 1");
  EXPECT_THAT(program.fault(), Tells(AccessProblem::not_modelled, "0x40200000", "write"));
}

TEST(Bus, TheWrongWidthIsReportedByName) {
  Program program("set16 CCM_CACRR, 1");
  EXPECT_THAT(program.fault(), Tells(AccessProblem::wrong_width, "CCM CACRR", "write", "2"));
}

TEST(Bus, A16BitRegisterIsNotWrittenByAWord) {
  Program program("set WDOG1_WMCR, 0");
  EXPECT_THAT(program.fault(), Tells(AccessProblem::wrong_width, "WDOG1 WMCR", "write", "4"));
}

TEST(Bus, APeripheralWhoseClockIsOffIsReportedWithItsGate) {
  Program program("get PIT_MCR");
  EXPECT_THAT(program.fault(), Tells(AccessProblem::clock_off, "PIT MCR", "read", "1", "6"));
}

TEST(Bus, TheFastPortsNeedNoClock) {
  Program program("set CCM_CCGR0, 0\n set CCM_CCGR1, 0\n get GPIO7_PSR\n keep 0");
  EXPECT_EQ(program.stopped_by(), "");
}

TEST(Bus, ABreakpointOtherThanTheBootLoadersEndsTheRun) {
  Program program("bkpt #0xAB");
  EXPECT_THAT(program.fault(), Tells(ChipProblem::breakpoint));
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
