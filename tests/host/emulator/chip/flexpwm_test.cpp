#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

const std::string kClock = "  set CCM_CCGR4, 0xFFFFFFFF\n";
const std::string kFaultsOff = kClock + R"(
    set16 PWM2_FCTRL0, 0xF000
    set16 PWM2_FSTS0, 0x000F
    set16 PWM2_SM2_DISMAP0, 0
)";
// A quarter at A, half at B, 20 kHz.
const std::string kValues = R"(
    set16 PWM2_SM2_CTRL2, 0x6010
    set16 PWM2_SM2_VAL1, 7499
    set16 PWM2_SM2_VAL3, 1875
    set16 PWM2_SM2_VAL5, 3750
    set16 PWM2_MCTRL, 0x004
)";
const std::string kRun = R"(
    set16 PWM2_MCTRL, 0x404
    set16 PWM2_OUTEN, 0x440
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_B0_10, 2
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_B0_11, 2
)";
const std::string kTurning = kFaultsOff + kValues + kRun;

void expect_duty(Program& program, double a, double b) {
  EXPECT_DOUBLE_EQ(program.teensy().pwm().duty(0), a);
  EXPECT_DOUBLE_EQ(program.teensy().pwm().duty(1), b);
}

void expect_duty_after(const std::string& code, double a, double b) {
  Program program(code);
  EXPECT_EQ(program.stopped_by(), "");
  expect_duty(program, a, b);
}

TEST(FlexPwm, ThePinsAreHighForTheirPartOfThePeriod) {
  Program program(kTurning);
  EXPECT_EQ(program.stopped_by(), "");
  expect_duty(program, 0.25, 0.5);
  EXPECT_EQ(program.teensy().pwm().period_counts(), 7500U);
}

TEST(FlexPwm, AFallBeyondThePeriodIsAlwaysHighAndOneAtTheRiseNever) {
  Program program(kFaultsOff + kValues + "  set16 PWM2_MCTRL, 0x040\n set16 PWM2_SM2_VAL3, 7500\n" +
                  "  set16 PWM2_SM2_VAL5, 0\n set16 PWM2_MCTRL, 0x004\n" + kRun);
  EXPECT_EQ(program.stopped_by(), "");
  expect_duty(program, 1.0, 0.0);
}

TEST(FlexPwm, EachConditionOfAnOutputIsNeeded) {
  expect_duty_after(kTurning + "  set IOMUXC_SW_MUX_CTL_PAD_GPIO_B0_10, 5", 0.0, 0.5);
  expect_duty_after(kTurning + "  set IOMUXC_SW_MUX_CTL_PAD_GPIO_B0_11, 5", 0.25, 0.0);
  expect_duty_after(kTurning + "  set16 PWM2_OUTEN, 0x400", 0.25, 0.0);
  expect_duty_after(kTurning + "  set16 PWM2_OUTEN, 0x040", 0.0, 0.5);
  expect_duty_after(kTurning + "  set16 PWM2_MCTRL, 0", 0.0, 0.0);
}

TEST(FlexPwm, AResetLeavesThePinsToTheDriversPullDowns) {
  Program program(kTurning);
  program.teensy().run_for(1ms);
  program.teensy().press_reset();
  expect_duty(program, 0.0, 0.0);
}

TEST(FlexPwm, WhatWasNeverLoadedDoesNotRun) {
  expect_duty_after(kFaultsOff + R"(
    set16 PWM2_SM2_CTRL2, 0x6010
    set16 PWM2_SM2_VAL1, 7499
    set16 PWM2_SM2_VAL3, 1875
    set16 PWM2_MCTRL, 0x400
    set16 PWM2_OUTEN, 0x440
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_B0_10, 2
  )",
                    0.0, 0.0);
}

TEST(FlexPwm, NewValuesAreTakenTogetherWhenThePeriodEnds) {
  Program program(kTurning + R"(
    pause 60
    set16 PWM2_SM2_VAL3, 3750
    set16 PWM2_SM2_VAL5, 1875
    set16 PWM2_MCTRL, 0x404
    get16 PWM2_MCTRL
    keep 0
    pause 50
    get16 PWM2_MCTRL
    keep 1
  )");
  program.teensy().run_for(70us);
  expect_duty(program, 0.25, 0.5);
  program.teensy().run_for(50us);
  expect_duty(program, 0.5, 0.25);
  EXPECT_EQ(program.result(0), 0x404U) << "LDOK while they wait";
  EXPECT_EQ(program.result(1), 0x400U);
}

TEST(FlexPwm, ValuesWithoutLdokAreNotTaken) {
  expect_duty_after(kTurning + "  pause 60\n set16 PWM2_SM2_VAL3, 3750\n set16 PWM2_SM2_VAL5, 1875", 0.25,
                    0.5);
}

TEST(FlexPwm, ValuesAreLockedWhileTheLastOnesWait) {
  for (const char* name :
       {"SM2_INIT", "SM2_VAL0", "SM2_VAL1", "SM2_VAL2", "SM2_VAL3", "SM2_VAL4", "SM2_VAL5"})
    EXPECT_THAT(Program(kFaultsOff + kValues + "  set16 PWM2_" + name + ", 1").fault(),
                Tells(PwmProblem::values_wait))
        << name;
}

TEST(FlexPwm, CldokUnlocksThem) {
  expect_duty_after(kTurning + R"(
    pause 60
    set16 PWM2_SM2_VAL3, 0
    set16 PWM2_MCTRL, 0x404
    set16 PWM2_MCTRL, 0x440
    set16 PWM2_SM2_VAL3, 3750
    set16 PWM2_MCTRL, 0x404
  )",
                    0.5, 0.5);
}

TEST(FlexPwm, AMaskTakesEffectAtOnceIfItSaysSo) {
  Program program(kTurning + "  pause 60\n set16 PWM2_MASK, 0x4400\n pause 1\n get16 PWM2_MASK\n keep 0");
  program.teensy().run_for(64us);
  expect_duty(program, 0.0, 0.5);
  EXPECT_EQ(program.result(0), 0x0400U) << "UPDATE_MASK reads as 0";
}

TEST(FlexPwm, AMaskOtherwiseWaitsForThePeriodsEnd) {
  Program program(kTurning + "  pause 60\n set16 PWM2_MASK, 0x0040");
  program.teensy().run_for(70us);
  expect_duty(program, 0.25, 0.5);
  program.teensy().run_for(50us);
  expect_duty(program, 0.25, 0.0);
}

TEST(FlexPwm, AMaskWaitsForeverIfThePeriodsEndForcesNothing) {
  expect_duty_after(kTurning + "  set16 PWM2_SM2_CTRL2, 0x6000\n pause 60\n set16 PWM2_MASK, 0x0440", 0.25,
                    0.5);
}

TEST(FlexPwm, AfterAResetEveryFaultInputKeepsTheOutputsOff) {
  expect_duty_after(kClock + kValues + kRun, 0.0, 0.0);
}

TEST(FlexPwm, AFaultStaysUntilItsFlagIsCleared) {
  Program program(kClock + "  set16 PWM2_FCTRL0, 0xF000\n" + kValues + kRun + R"(
    get16 PWM2_FSTS0
    keep 0
    pause 100
    set16 PWM2_FSTS0, 0x000F
    get16 PWM2_FSTS0
    keep 1
  )");
  program.teensy().run_for(50us);
  expect_duty(program, 0.0, 0.0);
  EXPECT_EQ(program.result(0), 0x000FU);
  program.teensy().run_for(100us);
  expect_duty(program, 0.25, 0.5);
  EXPECT_EQ(program.result(1), 0U);
}

TEST(FlexPwm, AFlagIsNotClearedWhileItsInputIsAtFault) {
  Program program(kClock +
                  "  set16 PWM2_FCTRL0, 0xE000\n set16 PWM2_FSTS0, 0x000F\n get16 PWM2_FSTS0\n keep 0\n" +
                  kValues + kRun);
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0) & 0xF, 1U);
  EXPECT_EQ(program.result(0) >> 8 & 0xF, 1U) << "FFPIN";
  expect_duty(program, 0.0, 0.0);
}

TEST(FlexPwm, AFaultSwitchesOffWhatItIsMappedToAlone) {
  expect_duty_after(kClock + "  set16 PWM2_SM2_DISMAP0, 0xFF0F\n" + kValues + kRun, 0.0, 0.5);
  expect_duty_after(kClock + "  set16 PWM2_SM2_DISMAP0, 0xFFF0\n" + kValues + kRun, 0.25, 0.0);
}

TEST(FlexPwm, WhatIsNotModelledIsRefused) {
  EXPECT_THAT(Program(kClock + "  set16 PWM2_SM2_CTRL, 0x0410").fault(),
              Tells(PwmProblem::prescaler_not_modelled));
  EXPECT_THAT(Program(kClock + "  set16 PWM2_SM2_CTRL, 0").fault(), Tells(PwmProblem::never_loaded));
  EXPECT_THAT(Program(kClock + "  set16 PWM2_SM2_CTRL2, 0x6110").fault(),
              Tells(PwmProblem::clock_not_modelled));
  EXPECT_THAT(Program(kClock + "  set16 PWM2_OUTEN, 0x440").fault(),
              Tells(PwmProblem::complementary_not_modelled));
  EXPECT_THAT(Program(kClock + "  set16 PWM2_FCTRL0, 0x0100").fault(),
              Tells(PwmProblem::fault_mode_not_modelled));
  EXPECT_THAT(Program(kClock + "  set16 PWM2_SM2_OCTRL, 0x0400").fault(),
              Tells(PwmProblem::output_control_not_modelled));
  EXPECT_THAT(Program(kClock + "  set16 PWM2_SM2_FRCTRL, 4").fault(),
              Tells(PwmProblem::fractions_not_modelled));
}

TEST(Bridges, DirectionPinsAndPwmDriveTheMotorsAsTheDriversTruthTableSays) {
  struct Case {
    std::uint32_t pins;
    double left, right;
    bool left_open, right_open;
  };
  for (const Case& each : {Case{0x0, 0, 0, true, true}, Case{0x5, 0.25, 0.5, false, false},
                           Case{0x20002, -0.25, -0.5, false, false}, Case{0x20007, 0, 0, false, false}}) {
    Program program(kTurning +
                    "  set IOMUXC_GPR_GPR27, 0xFFFFFFFF\n set GPIO7_GDIR, 0x2000F\n set GPIO7_DR, " +
                    std::to_string(each.pins));
    EXPECT_EQ(program.stopped_by(), "");
    const World::Bridges bridges = program.teensy().world().bridges();
    EXPECT_DOUBLE_EQ(bridges.duty[0], each.left) << each.pins;
    EXPECT_DOUBLE_EQ(bridges.duty[1], each.right) << each.pins;
    EXPECT_EQ(bridges.open[0], each.left_open) << each.pins;
    EXPECT_EQ(bridges.open[1], each.right_open) << each.pins;
  }
}

TEST(Bridges, APinThatIsNotThePortsIsLow) {
  const std::string forward =
      "  set IOMUXC_GPR_GPR27, 0xFFFFFFFF\n set GPIO7_GDIR, 0x2000F\n set GPIO7_DR, 5\n";
  Program left(kTurning + forward + "  set IOMUXC_SW_MUX_CTL_PAD_GPIO_B0_00, 1");
  EXPECT_EQ(left.stopped_by(), "");
  EXPECT_TRUE(left.teensy().world().bridges().open[0]);
  EXPECT_FALSE(left.teensy().world().bridges().open[1]);
  Program right(kTurning + forward + "  set IOMUXC_SW_MUX_CTL_PAD_GPIO_B0_02, 1");
  EXPECT_EQ(right.stopped_by(), "");
  EXPECT_FALSE(right.teensy().world().bridges().open[0]);
  EXPECT_TRUE(right.teensy().world().bridges().open[1]);
}

}  // namespace
}  // namespace astro::emulator
