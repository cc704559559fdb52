#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

constexpr const char* kPit = R"(
    set CCM_CCGR1, 0xFFFFFFFF
    set CCM_CSCMR1, 0x04900040   // 24 MHz
    set PIT_MCR, 0
)";

TEST(Time, SleepEndsWithTheInterruptAndNothingRunsMeanwhile) {
  Program program(R"(
    set SysTick_RVR, 599999      // 1 ms of the core's clock
    set SysTick_CVR, 0
    set SysTick_CSR, 7
    movs r5, #0
  1: wfi
    adds r5, #1
    mov r0, r5
    keep 0
    b 1b
  handler 15
    bx lr
  )");
  program.teensy().run_for(100'500us);
  EXPECT_EQ(program.result(0), 100U);
  EXPECT_LT(program.teensy().instructions(), 2000U);
}

TEST(Time, SleepIsEndedByAnInterruptThatPrimaskHoldsBack) {
  Program program(R"(
    cpsid i
    set SysTick_RVR, 599999
    set SysTick_CSR, 7
    wfi
    movs r0, #1
    keep 0
    stay
  handler 15
    keep 1
    bx lr
  )");
  program.teensy().run_for(2ms);
  EXPECT_EQ(program.result(0), 1U);
  EXPECT_EQ(program.result(1), 0U);
}

TEST(Time, NoInstructionRunsAgainWhereARunEndedAndTheNextBegan) {
  // The addition lies across the end of a page: the engine makes a block of it alone.
  Program program(R"(
    ldr r4, =20000
    movs r5, #0
    b 1f
    .ltorg
    .balign 4096
    .space 4094
  1: add.w r5, r5, #1
    subs r4, #1
    bne 1b
    mov r0, r5
    keep 0
    stay
  )");
  // 64 instructions each, of a loop of three: runs end between its two blocks, too.
  for (int run = 0; run < 2000; ++run) program.teensy().run_for(107ns);
  EXPECT_EQ(program.result(0), 20'000U);
}

TEST(Time, SysTickOfTheReferenceClockCountsAt100Kilohertz) {
  Program program(R"(
    set SysTick_RVR, 99
    set SysTick_CSR, 3
  1: wfi
    b 1b
  handler 15
    count 0
    bx lr
  )");
  program.teensy().run_for(10'500us);
  EXPECT_EQ(program.result(0), 10U);
}

TEST(Time, TheCycleCounterNeedsTracing) {
  EXPECT_THAT(Program("set DWT_CTRL, 1").fault(), Tells(ControlProblem::tracing_off, "DWT CTRL"));
  Program program(
      "set DCB_DEMCR, 0x01000000\n set DWT_CTRL, 1\n get DWT_CYCCNT\n mov r4, r0\n .rept 100\n nop\n "
      ".endr\n b 1f\n1: get DWT_CYCCNT\n subs r0, r4\n keep 0");
  program.teensy().run_for(1ms);
  // The counter moves a block of instructions at a time.
  EXPECT_NEAR(program.result(0), 105, 110);
  EXPECT_GT(program.result(0), 0U);
}

TEST(Pit, AFlagRisesAtTheEndOfEachPeriodWithoutAnInterrupt) {
  Program program(std::string(kPit) + R"(
    set PIT_CHANNEL3_LDVAL, 2399   // 100 us
    set PIT_CHANNEL3_TCTRL, 1
    movs r5, #0
  1: get PIT_CHANNEL3_TFLG
    cmp r0, #0
    beq 1b
    set PIT_CHANNEL3_TFLG, 1
    adds r5, #1
    mov r0, r5
    keep 0
    b 1b
  )");
  program.teensy().run_for(10'050us);
  EXPECT_EQ(program.result(0), 100U);
}

TEST(Pit, AChainedChannelCountsThePeriodsOfTheOneBefore) {
  Program program(std::string(kPit) + R"(
    set NVIC_ISER0 + 12, 0x04000000
    set PIT_CHANNEL0_LDVAL, 23     // 1 us
    set PIT_CHANNEL1_LDVAL, 99     // 100 of them
    set PIT_CHANNEL1_TCTRL, 7
    set PIT_CHANNEL0_TCTRL, 1
  1: wfi
    b 1b
  handler 138
    set PIT_CHANNEL1_TFLG, 1
    count 0
    bx lr
  )");
  program.teensy().run_for(10'050us);
  EXPECT_EQ(program.result(0), 100U);
}

TEST(Pit, ANewPeriodBeginsWhenTheOldOneIsOver) {
  Program program(std::string(kPit) + R"(
    set PIT_CHANNEL2_LDVAL, 23999  // 1 ms
    set PIT_CHANNEL2_TCTRL, 1
    set PIT_CHANNEL2_LDVAL, 2399
    get PIT_CHANNEL2_CVAL
    keep 0
  1: get PIT_CHANNEL2_TFLG
    cmp r0, #0
    beq 1b
    get PIT_CHANNEL2_CVAL
    keep 1
  )");
  program.teensy().run_for(900us);
  EXPECT_NEAR(program.result(0), 23'999, 5);
  EXPECT_EQ(program.result(1), 0U);
  program.teensy().run_for(200us);
  EXPECT_NEAR(program.result(1), 2'399, 5);
}

TEST(Pit, TheLifetimeTimerCountsMicrosecondsAndItsHalvesBelongTogether) {
  Program program(std::string(kPit) + R"(
    set PIT_CHANNEL0_LDVAL, 0xFFFFFFFF
    set PIT_CHANNEL1_LDVAL, 0xFFFFFFFF
    set PIT_CHANNEL1_TCTRL, 5
    set PIT_CHANNEL0_TCTRL, 1
    set SysTick_RVR, 5999999
    set SysTick_CSR, 7
    wfi
    get PIT_LTMR64H
    keep 0
    get PIT_LTMR64L
    mvns r0, r0
    keep 1
    stay
  handler 15
    bx lr
  )");
  program.teensy().run_for(11ms);
  EXPECT_EQ(program.result(0), 0xFFFF'FFFFU);
  EXPECT_NEAR(program.result(1), 240'000, 5) << "10 ms of 24 MHz";
}

TEST(Pit, TheUpperHalfOfTheLifetimeTimerIsACountLateWhenTheLowerHalfBeginsAnew) {
  Program program(std::string(kPit) + R"(
    set PIT_CHANNEL0_LDVAL, 0xFFFFFFFF
    set PIT_CHANNEL1_LDVAL, 0xFFFFFFFF
    set PIT_CHANNEL1_TCTRL, 5
    set PIT_CHANNEL0_TCTRL, 1
    pause 1                        // the first count is all ones, too
  1: get PIT_LTMR64H
    mov r4, r0
    get PIT_LTMR64L
    adds r1, r0, #1
    bne 1b
    mov r0, r4
    keep 0
    pause 1
    get PIT_LTMR64H
    keep 1
    stay
  )");
  program.teensy().run_for(100us);
  ASSERT_EQ(program.result(0), 0U);
  program.teensy().timers().age((std::uint64_t{1} << 32) - 24 * 110);  // 10 us are left
  program.teensy().run_for(20us);
  EXPECT_EQ(program.result(0), 0xFFFF'FFFFU);
  EXPECT_EQ(program.result(1), 0xFFFF'FFFEU);
}

TEST(Pit, AChannelDoesNotStartWhileTheModuleIsOff) {
  Program program("set CCM_CCGR1, 0xFFFFFFFF\n set PIT_CHANNEL0_TCTRL, 1");
  EXPECT_THAT(program.fault(), Tells(PitProblem::module_stopped, "0"));
}

TEST(Pit, AChannelIsNotChainedWhileItCounts) {
  Program program(std::string(kPit) + "set PIT_CHANNEL1_TCTRL, 1\n set PIT_CHANNEL1_TCTRL, 5");
  EXPECT_THAT(program.fault(), Tells(PitProblem::chained_while_counting, "1"));
}

TEST(Pit, TheFirstChannelHasNoneToBeChainedTo) {
  EXPECT_THAT(Program(std::string(kPit) + "set PIT_CHANNEL0_TCTRL, 4").fault(),
              Tells(PitProblem::nothing_to_chain_to, "0"));
}

TEST(Pit, ACountIsReadOnly) {
  EXPECT_THAT(Program(std::string(kPit) + "set PIT_CHANNEL2_CVAL, 1").fault(),
              Tells(PitProblem::count_written, "0x124"));
  EXPECT_THAT(Program(std::string(kPit) + "set PIT_LTMR64L, 1").fault(),
              Tells(PitProblem::count_written, "0x0E4"));
}

TEST(Time, SysTicksClockIsNotChangedWhileItCounts) {
  EXPECT_THAT(Program("set SysTick_RVR, 99\n set SysTick_CSR, 1\n set SysTick_CSR, 5").fault(),
              Tells(ControlProblem::tick_clock_changed));
}

}  // namespace
}  // namespace astro::emulator
