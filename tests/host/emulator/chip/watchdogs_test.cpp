#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

// The second time round the program keeps the cause of its reset and stops there.
const std::string kFirstTime = R"(
  get SRC_SRSR
  cmp r0, #1
  beq first
  keep 0
  stay
first:
)";
// 1 ms: 32 counts of 32 kHz. EN, UPDATE, CLK 1, CMD32EN.
const std::string kStarted = kFirstTime + R"(
    set RTWDOG_CNT, 0xD928C520
    set RTWDOG_TOVAL, 32
    set RTWDOG_CS, 0x21A0
)";
constexpr std::uint32_t kByWatchdog = 1U << 7, kPowerOn = 1U << 0;

TEST(Rtwdog, TheRomLeavesItOffAndLocked) {
  Program program(in_ram("get RTWDOG_CS\n keep 0"));
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0) & 0x0080, 0U) << "EN";
  EXPECT_EQ(program.result(0) & 0x0800, 0U) << "ULK";
  EXPECT_EQ(program.result(0) & 0x2520, 0x2520U) << "CMD32EN, RCS, LPO, UPDATE";
  EXPECT_FALSE(program.teensy().watchdog().running());
}

TEST(Rtwdog, LeftAloneItResetsTheChipInItsTimeAndTheCauseSaysSo) {
  Program program(in_ram(kStarted + "1: wfi\n b 1b"));
  program.teensy().run_for(990us);
  EXPECT_TRUE(program.teensy().watchdog().running());
  EXPECT_EQ(program.result(0), 0U);
  program.teensy().run_for(20us);
  EXPECT_EQ(program.result(0), kByWatchdog | kPowerOn);
}

TEST(Rtwdog, FedInTimeItNeverBites) {
  Program program(in_ram(kStarted + "1: pause 900\n set RTWDOG_CNT, 0xB480A602\n b 1b"));
  program.teensy().run_for(5ms);
  EXPECT_EQ(program.result(0), 0U);
}

TEST(Rtwdog, ALateMealIsTooLate) {
  Program program(in_ram(kStarted + "  pause 1100\n set RTWDOG_CNT, 0xB480A602\n wfi"));
  program.teensy().run_for(2ms);
  EXPECT_EQ(program.result(0), kByWatchdog | kPowerOn);
}

TEST(Rtwdog, ThePrescalerMakesItsTime256TimesAsLong) {
  Program program(in_ram(kFirstTime + R"(
    set RTWDOG_CNT, 0xD928C520
    set RTWDOG_TOVAL, 5
    set RTWDOG_CS, 0x31A0
  1: wfi
    b 1b
  )"));
  program.teensy().run_for(39ms);
  EXPECT_EQ(program.result(0), 0U);
  program.teensy().run_for(2ms);
  EXPECT_EQ(program.result(0), kByWatchdog | kPowerOn);
}

TEST(Rtwdog, ItIsOffAgainAfterAReset) {
  Program program(in_ram(kStarted + "1: wfi\n b 1b"));
  program.teensy().run_for(2ms);
  EXPECT_FALSE(program.teensy().watchdog().running());
  program.teensy().run_for(5ms);
  EXPECT_EQ(program.result(0), kByWatchdog | kPowerOn);
}

TEST(Rtwdog, ItCanBeStoppedWithTheKey) {
  Program program(in_ram(kStarted + R"(
    set RTWDOG_CNT, 0xD928C520
    set RTWDOG_CS, 0x2120
  1: wfi
    b 1b
  )"));
  program.teensy().run_for(5ms);
  EXPECT_EQ(program.result(0), 0U);
}

TEST(Rtwdog, TheKeyOpensItAndTheConfigurationClosesIt) {
  Program program(in_ram(kFirstTime + R"(
    set RTWDOG_CNT, 0xD928C520
    get RTWDOG_CS
    mov r4, r0
    set RTWDOG_WIN, 0
    set RTWDOG_TOVAL, 0x1234
    set RTWDOG_CS, 0x2120
    get RTWDOG_CS
    keep 1
    mov r0, r4
    keep 0
    get RTWDOG_TOVAL
    keep 2
  )"));
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0) & 0xC00, 0x800U) << "ULK";
  EXPECT_EQ(program.result(1) & 0xC00, 0x400U) << "RCS";
  EXPECT_EQ(program.result(2), 0x1234U);
}

TEST(Rtwdog, WithoutTheKeyNothingIsConfigured) {
  for (const char* write : {"RTWDOG_CS, 0x2120", "RTWDOG_TOVAL, 1", "RTWDOG_WIN, 0"})
    EXPECT_THAT(Program(in_ram(std::string("set ") + write)).fault(), Tells(WatchdogProblem::not_unlocked))
        << write;
}

TEST(Rtwdog, TheConfigurationIsOpenFor128BusClocks) {
  Program program(in_ram("set RTWDOG_CNT, 0xD928C520\n pause 1\n set RTWDOG_CS, 0x2120"));
  EXPECT_THAT(program.fault(), Tells(WatchdogProblem::not_unlocked));
}

TEST(Rtwdog, OneConfigurationUsesTheKeyUp) {
  Program program(in_ram("set RTWDOG_CNT, 0xD928C520\n set RTWDOG_CS, 0x2120\n set RTWDOG_TOVAL, 1"));
  EXPECT_THAT(program.fault(), Tells(WatchdogProblem::not_unlocked));
}

TEST(Rtwdog, OtherKeysAreRefused) {
  for (const char* key : {"0xD928C521", "0xA602B480", "0xC520", "0xA602", "0"})
    EXPECT_THAT(Program(in_ram(std::string("set RTWDOG_CNT, ") + key)).fault(),
                Tells(WatchdogProblem::wrong_key))
        << key;
}

TEST(Rtwdog, WithoutUpdateItIsLockedUntilTheNextReset) {
  Program program(in_ram("set RTWDOG_CNT, 0xD928C520\n set RTWDOG_CS, 0x2180\n set RTWDOG_CNT, 0xD928C520"));
  EXPECT_THAT(program.fault(), Tells(WatchdogProblem::update_forbidden));
}

// Without CMD32EN.
const std::string kHalves = kFirstTime + R"(
    set RTWDOG_CNT, 0xD928C520
    set RTWDOG_TOVAL, 32
    set RTWDOG_CS, 0x01A0
)";

TEST(Rtwdog, ByHalvesTheKeysAreWrittenLowerHalfFirst) {
  Program program(in_ram(kHalves + R"(
    movs r5, #5
  1: pause 900
    set RTWDOG_CNT, 0xA602
    set RTWDOG_CNT, 0xB480
    subs r5, #1
    bne 1b
    set RTWDOG_CNT, 0xC520
    set RTWDOG_CNT, 0xD928
    set RTWDOG_CS, 0x2120
  )"));
  program.teensy().run_for(10ms);
  EXPECT_EQ(program.result(0), 0U);
  EXPECT_FALSE(program.teensy().watchdog().running());
}

TEST(Rtwdog, HalvesThatDoNotBelongTogetherAreRefused) {
  EXPECT_THAT(Program(in_ram(kHalves + "  set RTWDOG_CNT, 0xD928")).fault(),
              Tells(WatchdogProblem::wrong_key));
  EXPECT_THAT(Program(in_ram(kHalves + "  set RTWDOG_CNT, 0xC520\n set RTWDOG_CNT, 0xB480")).fault(),
              Tells(WatchdogProblem::wrong_key));
  EXPECT_THAT(Program(in_ram(kHalves + "  set RTWDOG_CNT, 0xB480A602")).fault(),
              Tells(WatchdogProblem::wrong_key));
}

TEST(Rtwdog, WhatIsNotModelledIsRefused) {
  const std::string key = "  set RTWDOG_CNT, 0xD928C520\n";
  EXPECT_THAT(Program(in_ram(key + "  set RTWDOG_CS, 0x20A0")).fault(),
              Tells(WatchdogProblem::clock_not_modelled));
  EXPECT_THAT(Program(in_ram(key + "  set RTWDOG_CS, 0xA1A0")).fault(),
              Tells(WatchdogProblem::window_not_modelled));
  EXPECT_THAT(Program(in_ram(key + "  set RTWDOG_CS, 0x21E0")).fault(),
              Tells(WatchdogProblem::window_not_modelled));
}

TEST(Rtwdog, IsUnlockedByCodeThatDoesNotWaitForTheFlash) {
  EXPECT_THAT(Program("set RTWDOG_CNT, 0xD928C520").fault(), Tells(WatchdogProblem::unlocked_from_flash));
}

TEST(Rtwdog, MayRunWhenTheRomHandsOver) {
  const Program program("stay");
  Teensy teensy(program.hex(), {}, HandOver::untidy);
  EXPECT_TRUE(teensy.watchdog().running());
}

constexpr const char* kSleep = "\n1: wfi\n b 1b";

TEST(Wdog, ThePowerDownCounterOfEachRunsFromResetOn) {
  Program first(std::string("set16 WDOG2_WMCR, 0") + kSleep);
  EXPECT_EQ(first.stopped_by(15'900ms), "");
  EXPECT_THAT(first.fault(200ms), Tells(WatchdogProblem::power_down_not_stopped, "1"));
  Program second(std::string("set16 WDOG1_WMCR, 0") + kSleep);
  EXPECT_THAT(second.fault(16'100ms), Tells(WatchdogProblem::power_down_not_stopped, "2"));
}

TEST(Wdog, StoppedItStaysStopped) {
  Program program(std::string("set16 WDOG1_WMCR, 0\n set16 WDOG2_WMCR, 0\n get16 WDOG1_WMCR\n keep 0") +
                  kSleep);
  EXPECT_EQ(program.stopped_by(16'100ms), "");
  EXPECT_EQ(program.result(0), 0U);
}

TEST(Wdog, AResetStartsItAnew) {
  Program program(std::string("get16 WDOG1_WMCR\n keep 0") + kSleep);
  program.teensy().run_for(10s);
  EXPECT_EQ(program.result(0), 1U);
  program.teensy().press_reset();
  EXPECT_EQ(program.stopped_by(15'900ms), "");
  EXPECT_THAT(program.fault(200ms), Tells(WatchdogProblem::power_down_not_stopped, "1"));
}

TEST(Wdog, WhatHasBeenStoppedCannotBeStartedAgain) {
  EXPECT_THAT(Program("set16 WDOG1_WMCR, 0\n set16 WDOG1_WMCR, 1").fault(),
              Tells(WatchdogProblem::started_again, "1"));
}

TEST(Reset, EachCauseHasItsBitAndTheyGatherUntilTheyAreCleared) {
  Program program("get SRC_SRSR\n keep 0");
  program.teensy().run_for(1ms);
  EXPECT_EQ(program.result(0), 1U) << "power";
  program.teensy().press_reset();
  program.teensy().run_for(1ms);
  EXPECT_EQ(program.result(0), 1U | 1U << 3) << "and the pin";
  program.teensy().power_cycle();
  program.teensy().run_for(1ms);
  EXPECT_EQ(program.result(0), 1U);
}

TEST(Reset, CausesAreClearedByOnes) {
  Program program("set SRC_SRSR, 1\n get SRC_SRSR\n keep 0");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 0U);
}

TEST(Reset, TheFirmwareCanAskForOne) {
  Program program(kFirstTime + "  set SCB_AIRCR, 0x05FA0004");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 1U | 1U << 1);
}

TEST(Reset, FourWordsOutliveEverythingButThePower) {
  Program program("get SRC_GPR5\n keep 0\n adds r0, #1\n ldr r6, =SRC_GPR5\n str r0, [r6]");
  program.teensy().run_for(1ms);
  program.teensy().press_reset();
  program.teensy().run_for(1ms);
  EXPECT_EQ(program.result(0), 1U);
  program.teensy().power_cycle();
  program.teensy().run_for(1ms);
  EXPECT_EQ(program.result(0), 0U);
}

TEST(Reset, AnImageWhoseEntryLiesNowhereEndsTheRun) {
  Program program("stay");
  const auto flash = program.teensy().chip().memory().flash();
  const std::uint32_t nowhere = 0x3000'0000;
  std::memcpy(flash.data() + 0x1004, &nowhere, sizeof nowhere);
  program.teensy().press_reset();
  EXPECT_THAT(program.fault(), Tells(ChipProblem::entry_in_no_memory));
}

TEST(Fuses, AreNotWritten) {
  Program program("set CCM_CCGR2, 0xFFFFFFFF\n set OCOTP_CFG0, 1");
  EXPECT_THAT(program.fault(), Tells(FuseProblem::written));
}

TEST(Fuses, TellOneRobotFromAnother) {
  Program program("set CCM_CCGR2, 0xFFFFFFFF\n get OCOTP_MAC0\n keep 0\n get OCOTP_CFG0\n keep 1");
  EXPECT_EQ(program.stopped_by(), "");
  sim::Config robot;
  robot.seed += 76;
  Teensy other(program.hex(), robot);
  other.run_for(1ms);
  EXPECT_NE(other.word_at(Memory::kDtcm), program.result(0));
  EXPECT_NE(other.word_at(Memory::kDtcm + 4), program.result(1));
}

}  // namespace
}  // namespace astro::emulator
