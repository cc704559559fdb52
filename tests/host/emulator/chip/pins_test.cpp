#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

TEST(Gpio, TheFastPortDrivesThePinsThatItWasGiven) {
  Program program(R"(
    set IOMUXC_GPR_GPR27, 0xFFFFFFFF
    set GPIO7_DR_SET, 0x2000F
    set GPIO7_GDIR, 0x2000F
    set GPIO7_DR_CLEAR, 0x3
    set GPIO7_DR_TOGGLE, 0x5
    get GPIO7_DR
    keep 0
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 0x20009U);
  EXPECT_EQ(program.teensy().gpio7().driven(), 0x20009U);
  EXPECT_EQ(program.teensy().gpio7().outputs(), 0x2000FU);
}

TEST(Gpio, APinIsNotDrivenBeforeItIsAnOutput) {
  Program program("set IOMUXC_GPR_GPR27, 0xFFFFFFFF\n set GPIO7_DR, 3\n set GPIO7_GDIR, 2");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.teensy().gpio7().driven(), 2U);
}

TEST(Gpio, ThePadsStateIsTheOutputsAndWhatTheWorldApplies) {
  Program program(R"(
    set IOMUXC_GPR_GPR27, 0xFFFFFFFF
    set GPIO7_GDIR, 0xF
    set GPIO7_DR, 0xA
  1: get GPIO7_PSR
    keep 0
    b 1b
  )");
  program.teensy().run_for(1ms);
  EXPECT_EQ(program.result(0), 0xFFFF'FFFAU);
  program.teensy().world().set_driver_fault(true);
  program.teensy().run_for(1ms);
  EXPECT_EQ(program.result(0), 0xFFFE'FFFAU) << "pin 8, pulled down by the driver";
}

TEST(Gpio, TheFastPortCannotMoveAPinOfTheSlowOne) {
  EXPECT_THAT(Program("set GPIO7_DR_SET, 1").fault(), Tells(GpioProblem::pins_of_other_port, "7", "DR", "2"));
  EXPECT_THAT(Program("set IOMUXC_GPR_GPR26, 1\n set GPIO6_GDIR, 3").fault(),
              Tells(GpioProblem::pins_of_other_port, "6", "GDIR", "1"));
}

TEST(Gpio, TheSlowPortCannotMoveAPinOfTheFastOne) {
  Program program("set IOMUXC_GPR_GPR27, 0x8\n set GPIO2_DR_TOGGLE, 0x8");
  EXPECT_THAT(program.fault(), Tells(GpioProblem::pins_of_other_port, "2", "DR", "7"));
}

TEST(Gpio, PinsThatDoNotChangeMayBelongToTheOtherPort) {
  Program program("set IOMUXC_GPR_GPR27, 0xF0\n set GPIO2_DR, 0x0F\n set GPIO2_GDIR, 0x0F");
  EXPECT_EQ(program.stopped_by(), "");
}

TEST(Gpio, WhoOwnsAPinIsForgottenByAReset) {
  Program program("set GPIO2_GDIR, 1\n set IOMUXC_GPR_GPR27, 0xFFFFFFFF\n set GPIO7_GDIR, 1");
  program.teensy().run_for(1ms);
  program.teensy().press_reset();
  EXPECT_EQ(program.teensy().gpio7().outputs(), 0U);
  EXPECT_EQ(program.stopped_by(), "") << "the program may move GPIO2's pin again";
}

TEST(Gpio, ThePadsStateIsReadOnly) {
  EXPECT_THAT(Program("set GPIO2_PSR, 1").fault(), Tells(GpioProblem::pad_state_written, "2"));
}

TEST(Gpio, InterruptsOfThePinsAreRefused) {
  EXPECT_THAT(Program("set GPIO7_IMR, 1").fault(), Tells(GpioProblem::interrupts_not_modelled, "7"));
  EXPECT_EQ(Program("set GPIO7_IMR, 0\n set GPIO7_ISR, 0xFFFFFFFF").stopped_by(), "");
}

TEST(Gpio, TheSlowPortsNeedTheirClockAndTheFastOnesNone) {
  EXPECT_THAT(Program("set CCM_CCGR0, 0x3FFFFFFF\n get GPIO2_DR").fault(),
              Tells(AccessProblem::clock_off, "GPIO2 DR", "read", "0", "15"));
  EXPECT_EQ(Program("set CCM_CCGR0, 0\n get GPIO7_DR").stopped_by(), "");
}

TEST(Pads, AReadBringsBackWhatWasWritten) {
  Program program(R"(
    get IOMUXC_SW_MUX_CTL_PAD_GPIO_B0_10
    keep 0
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_B0_10, 0x12
    get IOMUXC_SW_MUX_CTL_PAD_GPIO_B0_10
    keep 1
    get IOMUXC_SW_PAD_CTL_PAD_GPIO_B0_10
    keep 2
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 5U) << "GPIO after a reset";
  EXPECT_EQ(program.result(1), 0x12U);
  EXPECT_EQ(program.result(2), 0x10B0U) << "keeper after a reset";
}

TEST(FlexRam, TheBanksAreSharedOutByRegister) {
  Program program(R"(
    set IOMUXC_GPR_GPR17, 0xAAAAAAFF
    get 0x20060000 - 4
    set 0x0001FFFC, 7
    get 0x0001FFFC
    keep 0
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 7U);
}

TEST(FlexRam, BehindItsBanksNobodyAnswers) {
  Program program(R"(
    ldr r1, =0x00020000
    ldr r0, [r1]
    movs r0, #1
    keep 0
    stay
  handler 3
    movs r0, #2
    keep 0
    stay
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 2U) << "a bus fault: four banks are code, of 32 KB each";
}

TEST(FlexRam, TheVectorsOfTheNextResetStayWithTheRom) {
  EXPECT_THAT(Program("set IOMUXC_GPR_GPR16, 7").fault(), Tells(FlexRamProblem::vectors_moved));
}

TEST(FlexRam, TheSizesOfTheCoupledMemoriesAreWithinTheirCodes) {
  for (const char* sizes : {"0x00A20000", "0x002A0000", "0x00B00000", "0x000B0000"})
    EXPECT_THAT(Program(std::string("set IOMUXC_GPR_GPR14, ") + sizes).fault(),
                Tells(FlexRamProblem::size_unknown))
        << sizes;
}

}  // namespace
}  // namespace astro::emulator
