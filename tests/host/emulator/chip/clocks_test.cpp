#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

// The steps from what the ROM leaves, 396 MHz, to 600 MHz, each of them complete with its wait.
constexpr const char* kSteps = R"(
  .macro fast_supply
    set CCM_CCGR6, 0xFFFFFFFF
    set DCDC_REG3, 0x112         // 1.25 V
    until DCDC_REG0, 0x80000000, 0x80000000
  .endm
  .macro detour
    set CCM_CBCMR, 0x2DAE9324    // crystal
    set CCM_CBCDR, 0x020A8200
    until CCM_CDHIPR, 0x20, 0
  .endm
  .macro fast_pll
    set CCM_ANALOG_PLL_ARM, 0x1000
    set CCM_ANALOG_PLL_ARM, 0x2064
    until CCM_ANALOG_PLL_ARM, 0x80000000, 0x80000000
  .endm
  .macro divide core, rest
    set CCM_CACRR, \core
    until CCM_CDHIPR, 0x10000, 0
    set CCM_CBCDR, 0x02000000 + \rest
    until CCM_CDHIPR, 0x2, 0
  .endm
)";

Program with_steps(const std::string& code) { return Program(kSteps + code); }

TEST(Clocks, TheChipStartsAsTheRomLeavesIt) {
  Program program("stay");
  EXPECT_EQ(program.teensy().ccm().core_mhz(), 396U);
  EXPECT_EQ(program.teensy().ccm().bus_mhz(), 132U);
}

TEST(Clocks, TheSequenceOfTheManualLeadsTo600MegahertzAndABusOf150) {
  Program program = with_steps(R"(
    fast_supply
    detour
    fast_pll
    divide 1, 0x300
    set CCM_CBCDR, 0x300
    until CCM_CDHIPR, 0x20, 0
    movs r0, #1
    keep 0
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 1U);
  EXPECT_EQ(program.teensy().ccm().core_mhz(), 600U);
  EXPECT_EQ(program.teensy().ccm().bus_mhz(), 150U);
}

TEST(Clocks, TheDetourIsTheCrystal) {
  Program program = with_steps("detour");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.teensy().ccm().core_mhz(), 24U);
}

TEST(Clocks, AResetBringsBackWhatTheRomLeaves) {
  Program program = with_steps("detour");
  program.teensy().run_for(100us);
  program.teensy().press_reset();
  EXPECT_EQ(program.teensy().ccm().core_mhz(), 396U);
}

TEST(Clocks, ThePllIsNotChangedUnderTheCore) {
  Program program("set CCM_ANALOG_PLL_ARM, 0x2064");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::pll_in_use));
}

TEST(Clocks, TheFactorOfThePllIsWithinItsRange) {
  EXPECT_THAT(with_steps("detour\n set CCM_ANALOG_PLL_ARM, 0x2035").fault(),
              Tells(ClockProblem::pll_factor_out_of_range));
  EXPECT_THAT(with_steps("detour\n set CCM_ANALOG_PLL_ARM, 0x206D").fault(),
              Tells(ClockProblem::pll_factor_out_of_range));
}

TEST(Clocks, ThePllLocksAfter60Microseconds) {
  Program program = with_steps(R"(
    detour
    set CCM_ANALOG_PLL_ARM, 0x1000
    set CCM_ANALOG_PLL_ARM, 0x2064
    movs r5, #0
  1: get CCM_ANALOG_PLL_ARM
    adds r5, #1
    cmp r0, #0
    bpl 1b
    mov r0, r5
    keep 0
  )");
  EXPECT_EQ(program.stopped_by(), "");
  constexpr int kInstructions = 5;  // a turn
  EXPECT_NEAR(program.result(0), 60 * 600 / kInstructions, 10);
}

TEST(Clocks, SetAndClearCopiesChangeTheirBitsAlone) {
  Program program(R"(
    set CCM_ANALOG_PLL_USB1_SET, 0x40
    get CCM_ANALOG_PLL_USB1
    keep 0
    set CCM_ANALOG_PLL_USB1_CLR, 0x2000
    get CCM_ANALOG_PLL_USB1
    keep 1
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0) & 0xFFFF, 0x3040U);
  EXPECT_EQ(program.result(1) & 0xFFFF, 0x1040U);
}

TEST(Clocks, TheUsbPllLocksAfterItIsSwitchedOn) {
  Program program = with_steps(R"(
    set CCM_ANALOG_PLL_USB1_CLR, 0x1000
    get CCM_ANALOG_PLL_USB1
    keep 0
    set CCM_ANALOG_PLL_USB1_SET, 0x1000
    get CCM_ANALOG_PLL_USB1
    keep 1
    until CCM_ANALOG_PLL_USB1, 0x80000000, 0x80000000
    movs r0, #1
    keep 2
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0) >> 31, 0U);
  EXPECT_EQ(program.result(1) >> 31, 0U);
  EXPECT_EQ(program.result(2), 1U);
}

TEST(Clocks, TheCoreDoesNotRunFromAPllThatHasNotLocked) {
  Program program = with_steps(R"(
    detour
    set CCM_ANALOG_PLL_ARM, 0x1000
    set CCM_ANALOG_PLL_ARM, 0x2042
    set CCM_CBCDR, 0x000A8200
  )");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::pll_not_locked));
}

TEST(Clocks, TheCoreDoesNotRunFromAPllThatIsOff) {
  Program program = with_steps("detour\n set CCM_ANALOG_PLL_ARM, 0x1000\n set CCM_CBCDR, 0x000A8200");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::pll_not_locked));
}

TEST(Clocks, TheCoreDoesNotRunFromAPllThatIsBypassed) {
  Program program = with_steps(R"(
    detour
    set CCM_ANALOG_PLL_ARM, 0x12042
    until CCM_ANALOG_PLL_ARM, 0x80000000, 0x80000000
    set CCM_CBCDR, 0x000A8200
  )");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::pll_bypassed));
}

TEST(Clocks, SixHundredMegahertzNeedTheirVoltage) {
  Program program = with_steps("detour\n fast_pll\n divide 1, 0x300\n set CCM_CBCDR, 0x300");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::too_fast_for_voltage, "600"));
}

TEST(Clocks, TheVoltageCountsOnceItHasSettled) {
  Program program = with_steps(R"(
    detour
    fast_pll
    divide 1, 0x300
    set CCM_CCGR6, 0xFFFFFFFF
    set DCDC_REG3, 0x112
    get DCDC_REG0
    keep 0
    set CCM_CBCDR, 0x300
  )");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::too_fast_for_voltage, "600"));
  EXPECT_EQ(program.result(0) >> 31, 0U) << "STS_DC_OK";
}

TEST(Clocks, TheCoreIsNotFasterThan600Megahertz) {
  Program program = with_steps("fast_supply\n detour\n fast_pll\n divide 0, 0x300\n set CCM_CBCDR, 0x300");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::core_too_fast, "1200"));
}

TEST(Clocks, TheBusIsNotFasterThan150Megahertz) {
  Program program = with_steps("fast_supply\n detour\n fast_pll\n divide 1, 0x200\n set CCM_CBCDR, 0x200");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::bus_too_fast, "200"));
}

TEST(Clocks, ADividerIsNotChangedDuringTheHandshakeOfTheLastChange) {
  Program program = with_steps("detour\n set CCM_CACRR, 3\n set CCM_CACRR, 1");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::last_change_under_way));
}

TEST(Clocks, AHandshakeShowsWhichChangeItIsOf) {
  Program program = with_steps(R"(
    detour
    set CCM_CACRR, 3
    get CCM_CDHIPR
    keep 0
    until CCM_CDHIPR, 0x10000, 0
    set CCM_CBCDR, 0x020A8600
    get CCM_CDHIPR
    keep 1
    until CCM_CDHIPR, 2, 0
    get CCM_CDHIPR
    keep 2
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 0x10000U) << "ARM_PODF";
  EXPECT_EQ(program.result(1), 0x2U) << "AHB_PODF";
  EXPECT_EQ(program.result(2), 0U);
}

TEST(Clocks, OtherSourcesThanCrystalAndArmPllAreRefused) {
  EXPECT_THAT(Program("set CCM_CBCDR, 0x020A8200").fault(), Tells(ClockProblem::crystal_not_selected));
  EXPECT_THAT(Program("set CCM_CBCMR, 0x2DA29324").fault(), Tells(ClockProblem::arm_pll_not_selected));
}

TEST(Clocks, TheTimersClockIsAWholePartOfTheCores) {
  Program program("set CCM_CSCMR1, 0x04900000");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::timer_clock_not_whole));
}

TEST(Clocks, ABusBelowAMegahertzIsNoClockForTheTimers) {
  Program program = with_steps("detour\n set CCM_CBCDR, 0x02001F00\n set CCM_CSCMR1, 0x04900000");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::timer_clock_not_whole));
}

TEST(Clocks, TheTimersRunFromTheCrystalOrTheBus) {
  Program crystal("set CCM_CSCMR1, 0x04900041");
  EXPECT_EQ(crystal.stopped_by(), "");
  EXPECT_EQ(crystal.teensy().ccm().timer_hz(), 12'000'000U);
  Program bus = with_steps("detour\n set CCM_CBCDR, 0x02000000\n set CCM_CSCMR1, 0x04900000");
  EXPECT_EQ(bus.stopped_by(), "");
  EXPECT_EQ(bus.teensy().ccm().timer_hz(), 24'000'000U);
}

TEST(Clocks, TheSerialPortRunsFromTheCrystalOrA80MegahertzClock) {
  Program program("set CCM_CSCDR1, 0x06490B40");
  EXPECT_EQ(program.teensy().ccm().uart_hz(), 80'000'000U);
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.teensy().ccm().uart_hz(), 24'000'000U);
}

TEST(Clocks, TheRomLeavesTheGatesOfWhatItDoesNotUseClosed) {
  for (const char* access : {"PIT_MCR", "ADC1_CFG", "OCOTP_CFG0", "LPUART6_BAUD", "USB1_USBCMD", "DCDC_REG0"})
    EXPECT_THAT(Program(std::string("get ") + access).fault(), Tells(AccessProblem::clock_off)) << access;
  for (const char* access : {"XBARA1_SEL33", "ENC1_CTRL", "ENC2_CTRL", "PWM2_MCTRL"})
    EXPECT_THAT(Program(std::string("set16 ") + access + ", 0").fault(), Tells(AccessProblem::clock_off))
        << access;
}

TEST(Supply, TheCoreNeverGetsMoreThan1V3) {
  Program program("set CCM_CCGR6, 0xFFFFFFFF\n set DCDC_REG3, 0x115");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::voltage_too_high));
}

TEST(Supply, AFastCoreKeepsItsVoltage) {
  Program program = with_steps(R"(
    fast_supply
    detour
    fast_pll
    divide 1, 0x300
    set CCM_CBCDR, 0x300
    until CCM_CDHIPR, 0x20, 0
    set DCDC_REG3, 0x10E
  )");
  EXPECT_THAT(program.fault(), Tells(ClockProblem::voltage_too_low, "1150", "600"));
}

TEST(Supply, ASlowCoreMayHaveLess) {
  Program program = with_steps(R"(
    set CCM_CCGR6, 0xFFFFFFFF
    set DCDC_REG3, 0x10D
    until DCDC_REG0, 0x80000000, 0x80000000
    movs r0, #1
    keep 0
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 1U);
}

}  // namespace
}  // namespace astro::emulator
