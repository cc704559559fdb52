#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;
using testing::Each;
using testing::ElementsAre;

// The flash cannot be read while it works, so these lines run from ITCM.
const std::string kCommands = R"(
  .macro unlock
    set FLEXSPI_LUTKEY, 0x5AF05AF0
    set FLEXSPI_LUTCR, 2
  .endm
  .macro prepare first, second, address, bytes
    set FLEXSPI_LUT60, \first
    set FLEXSPI_LUT61, \second
    set FLEXSPI_INTR, 0x0B
    set FLEXSPI_IPCR0, \address
    set FLEXSPI_IPCR1, 0x000F0000 + \bytes
  .endm
  .macro finish
    until FLEXSPI_INTR, 1, 1
  .endm
  .macro command first, second=0, address=0, bytes=0
    prepare \first, \second, \address, \bytes
    set FLEXSPI_IPCMD, 1
    finish
  .endm
  .macro enable
    command 0x0406
  .endm
  .macro erase address
    command 0x08180420, 0, \address
  .endm
  .macro pair low, high
    set FLEXSPI_TFDR0, \low
    set FLEXSPI_TFDR1, \high
    set FLEXSPI_INTR, 0x40
  .endm
  .macro write address, low, high
    set FLEXSPI_IPTXFCR, 1
    pair \low, \high
    command 0x08180402, 0x2001, \address, 8
  .endm
  .macro status
    set FLEXSPI_IPRXFCR, 1
    command 0x24010405, 0, 0, 1
    get FLEXSPI_RFDR0
  .endm
  .macro idle
    1002: status
    lsls r0, #31
    bne 1002b
  .endm
)";

/// Erasing takes but 1 ms here.
struct Worker : Program {
  explicit Worker(const std::string& code) : Program(kCommands + in_ram(code)) {
    teensy().flash().times.erase = 1'000 * kCyclesPerMicrosecond;
  }
  Remark fault() { return Program::fault(10ms); }
  std::string outcome() { return fault().sentence; }
  std::span<std::uint8_t> parameters() { return teensy().flash().parameters(); }
};

// Instruction and data cache on, as is the default memory map: the flash is cached.
constexpr const char* kCached = "unlock\n set SCB_CCR, 0x30000\n enable\n erase 0x1F1000\n idle\n";

TEST(Flash, IsNotReadFromALineThatMayHaveBeenFetchedWhileItWorked) {
  constexpr const char* kOtherSector = "  get 0x601F0020\n";
  EXPECT_THAT(Worker(std::string(kCached) + kOtherSector).fault(),
              Tells(ChipProblem::stale_cache_line, "0x601F0020"));
  EXPECT_THAT(Worker(std::string(kCached) + "set SCB_DCIMVAC, 0x601F0000\n" + kOtherSector).fault(),
              Tells(ChipProblem::stale_cache_line, "0x601F0020"))
      << "the line before";
  EXPECT_EQ(Worker(std::string(kCached) + "set SCB_DCIMVAC, 0x601F0020\n" + kOtherSector).outcome(), "");
}

TEST(Flash, ErasingSetsASectorAndNoMore) {
  Worker program("unlock\n enable\n erase 0x1F1800\n idle");
  std::ranges::fill(program.parameters(), std::uint8_t{0x5A});
  EXPECT_EQ(program.outcome(), "");
  EXPECT_EQ(program.parameters()[0xFFF], 0x5A);
  EXPECT_THAT(program.parameters().subspan(0x1000, 0x1000), Each(0xFF));
  EXPECT_EQ(program.parameters()[0x2000], 0x5A);
}

TEST(Flash, ProgrammingClearsBitsAndSetsNone) {
  Worker program("unlock\n enable\n write 0x1F0010, 0x0F0F0F0F, 0xFFFFFFFF\n idle");
  std::ranges::fill(program.parameters(), std::uint8_t{0x3C});
  EXPECT_EQ(program.outcome(), "");
  EXPECT_THAT(program.parameters().subspan(0x10, 4), Each(0x0C));
  EXPECT_THAT(program.parameters().subspan(0x14, 4), Each(0x3C));
}

TEST(Flash, WhatIsProgrammedReadsBackWhereTheProcessorSeesIt) {
  Worker program("unlock\n enable\n write 0x1F0000, 0x11223344, 0x55667788\n idle\n get 0x601F0004\n keep 0");
  EXPECT_EQ(program.outcome(), "");
  EXPECT_EQ(program.result(0), 0x55667788U);
}

TEST(Flash, BeyondThePagesEndProgrammingGoesOnAtItsBegin) {
  Worker program("unlock\n enable\n write 0x1F01FC, 0x04030201, 0x08070605\n idle");
  EXPECT_EQ(program.outcome(), "");
  EXPECT_THAT(program.parameters().subspan(0x1FC, 4), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(program.parameters().subspan(0x100, 4), ElementsAre(5, 6, 7, 8));
  EXPECT_THAT(program.parameters().subspan(0x200, 4), Each(0xFF));
}

TEST(Flash, APageHas256Bytes) {
  const std::string feed = R"(
    unlock
    enable
    set FLEXSPI_IPTXFCR, 1
    prepare 0x08180402, 0x2001, 0x1F0000, BYTES
    set FLEXSPI_IPCMD, 1
    movs r5, #BYTES / 8
  1: until FLEXSPI_INTR, 0x40, 0x40
    pair 0, 0
    subs r5, #1
    bne 1b
    finish
    idle
  )";
  Worker page(".equ BYTES, 256\n" + feed);
  EXPECT_EQ(page.outcome(), "");
  EXPECT_THAT(page.parameters().first(256), Each(0));
  Worker more(".equ BYTES, 264\n" + feed);
  EXPECT_THAT(more.fault(), Tells(FlashProblem::more_than_a_page));
}

TEST(Flash, WithoutWriteEnableNothingIsWritten) {
  EXPECT_THAT(Worker("unlock\n write 0x1F0000, 0, 0").fault(), Tells(FlashProblem::not_write_enabled));
  EXPECT_THAT(Worker("unlock\n erase 0x1F0000").fault(), Tells(FlashProblem::not_write_enabled));
}

TEST(Flash, EachWriteNeedsItsOwnWriteEnable) {
  Worker program("unlock\n enable\n write 0x1F0000, 0, 0\n idle\n write 0x1F0008, 0, 0");
  EXPECT_THAT(program.fault(), Tells(FlashProblem::not_write_enabled));
}

TEST(Flash, TheStatusTellsBusyAndEnabled) {
  Worker program(R"(
    unlock
    status
    keep 0
    enable
    status
    keep 1
    write 0x1F0000, 0, 0
    status
    keep 2
    idle
    status
    keep 3
  )");
  EXPECT_EQ(program.outcome(), "");
  EXPECT_EQ(program.result(0) & 0xFF, 0U);
  EXPECT_EQ(program.result(1) & 0xFF, 2U);
  EXPECT_EQ(program.result(2) & 0xFF, 3U);
  EXPECT_EQ(program.result(3) & 0xFF, 0U);
}

TEST(Flash, APageAndASectorTakeTheirTypicalTimes) {
  Worker page("unlock\n enable\n write 0x1F0000, 0, 0");
  page.teensy().run_for(350us);
  EXPECT_TRUE(page.teensy().flash().busy());
  page.teensy().run_for(100us);
  EXPECT_FALSE(page.teensy().flash().busy());
  Program sector(kCommands + in_ram("unlock\n enable\n erase 0x1F0000"));
  sector.teensy().run_for(44ms);
  EXPECT_TRUE(sector.teensy().flash().busy());
  sector.teensy().run_for(2ms);
  EXPECT_FALSE(sector.teensy().flash().busy());
}

TEST(Flash, WhileItWorksItTakesNoCommandButTheStatus) {
  for (const char* command :
       {"enable", "write 0x1F0100, 0, 0", "erase 0x1F1000", "command 0x2401049F, 0, 0, 3"})
    EXPECT_THAT(Worker(std::string("unlock\n enable\n write 0x1F0000, 0, 0\n") + command).fault(),
                Tells(FlashProblem::busy))
        << command;
}

TEST(Flash, NobodyReadsItWhileItWorks) {
  EXPECT_THAT(Worker("unlock\n enable\n write 0x1F0000, 0, 0\n get 0x60001000").fault(),
              Tells(ChipProblem::busy_flash_read, "0x60001000"));
}

TEST(Flash, NobodyExecutesItWhileItWorks) {
  Worker program("unlock\n enable\n write 0x1F0000, 0, 0\n ldr r3, =main\n bx r3");
  EXPECT_THAT(program.fault(), Tells(ChipProblem::busy_flash_executed));
}

TEST(Flash, AnInterruptWhoseHandlerLiesInItIsNotServedWhileItWorks) {
  Worker program("unlock\n enable\n erase 0x1F0000\n set SysTick_RVR, 5999\n set SysTick_CSR, 7");
  EXPECT_THAT(program.fault(), Tells(ChipProblem::busy_flash_executed));
}

TEST(Flash, OnlyTheParametersSectorsAreWritten) {
  EXPECT_THAT(Worker("unlock\n enable\n erase 0x1EF000").fault(),
              Tells(FlashProblem::outside_parameters, "0x1EF000"));
  EXPECT_THAT(Worker("unlock\n enable\n write 0x1FF000, 0, 0").fault(),
              Tells(FlashProblem::outside_parameters, "0x1FF000"));
}

TEST(Flash, ItsIdentityIsTheW25q16s) {
  Worker program(
      "unlock\n set FLEXSPI_IPRXFCR, 1\n command 0x2401049F, 0, 0, 3\n get FLEXSPI_RFDR0\n keep 0");
  EXPECT_EQ(program.outcome(), "");
  EXPECT_EQ(program.result(0), 0x1540EFU);
}

TEST(Flash, PowerFailsAfterSoManyBytes) {
  Worker program("unlock\n enable\n write 0x1F0000, 0, 0\n idle");
  program.teensy().flash().cut_power_after(5);
  EXPECT_EQ(program.outcome(), "");
  EXPECT_FALSE(program.teensy().flash().powered());
  EXPECT_THAT(program.parameters().first(5), Each(0));
  EXPECT_THAT(program.parameters().subspan(5, 3), Each(0xFF));
  program.teensy().power_cycle();
  EXPECT_TRUE(program.teensy().flash().powered());
}

TEST(Flash, OfATornSectorSomeBitsAreErased) {
  Worker program("unlock\n enable\n erase 0x1F0000\n idle");
  std::ranges::fill(program.parameters(), std::uint8_t{0});
  program.teensy().flash().cut_power_after(5, sim::Tear::torn);
  EXPECT_EQ(program.outcome(), "");
  EXPECT_THAT(program.parameters().first(5), Each(0xFF));
  const auto torn = program.parameters().subspan(5, 4096 - 5);
  EXPECT_GT(std::ranges::count_if(torn, [](auto byte) { return byte != 0 && byte != 0xFF; }), 3000);
  EXPECT_THAT(program.parameters().subspan(4096, 4096), Each(0));
}

TEST(Flash, TheRomFindsNoImageInABusyFlash) {
  Worker program("unlock\n enable\n erase 0x1F0000");
  program.teensy().run_for(500us);
  program.teensy().press_reset();
  EXPECT_THAT(program.fault(), Tells(ChipProblem::image_in_busy_flash));
}

TEST(Flexspi, TheTableIsLockedUntilItsKeyIsGiven) {
  EXPECT_THAT(Program("set FLEXSPI_LUT60, 0x0406").fault(), Tells(FlexspiProblem::table_locked));
  EXPECT_THAT(Program("set FLEXSPI_LUTKEY, 0x5AF05AF1").fault(), Tells(FlexspiProblem::wrong_key));
  EXPECT_THAT(Program("set FLEXSPI_LUTCR, 2").fault(), Tells(FlexspiProblem::without_key));
}

TEST(Flexspi, TheKeyIsForOneWriteAndLocksAsWell) {
  EXPECT_THAT(Worker("unlock\n set FLEXSPI_LUTCR, 1").fault(), Tells(FlexspiProblem::without_key));
  EXPECT_THAT(
      Worker("unlock\n set FLEXSPI_LUTKEY, 0x5AF05AF0\n set FLEXSPI_LUTCR, 1\n set FLEXSPI_LUT61, 0").fault(),
      Tells(FlexspiProblem::table_locked));
}

TEST(Flexspi, OnlyTheLastSequenceIsTheFirmwares) {
  EXPECT_THAT(Worker("unlock\n set FLEXSPI_IPCR1, 0x00000000\n set FLEXSPI_IPCMD, 1").fault(),
              Tells(FlexspiProblem::sequence_not_the_firmwares));
  EXPECT_THAT(Worker("unlock\n set FLEXSPI_IPCR1, 0x010F0000\n set FLEXSPI_IPCMD, 1").fault(),
              Tells(FlexspiProblem::sequence_not_the_firmwares));
}

TEST(Flexspi, ACommandIsNotTriggeredWhileAnotherOneRuns) {
  EXPECT_THAT(
      Worker("unlock\n prepare 0x0406, 0, 0, 0\n set FLEXSPI_IPCMD, 1\n set FLEXSPI_IPCMD, 1").fault(),
      Tells(FlexspiProblem::command_under_way, "0x06"));
}

TEST(Flexspi, StepsAndCommandsThatNobodyKnowsAreRefused) {
  EXPECT_THAT(Worker("unlock\n command 0x0C010406").fault(), Tells(FlexspiProblem::step_not_modelled, "3"));
  EXPECT_THAT(Worker("unlock\n command 0x04C7").fault(), Tells(FlexspiProblem::command_unknown, "0xC7"));
}

TEST(Flexspi, ACommandNeedsTheStepsThatTheFlashExpectsOfIt) {
  for (const char* sequence :
       {"0x0402, 0x2001, 0x1F0000, 8", "0x08180402, 0, 0x1F0000, 0", "0x0420, 0, 0x1F0000", "0x0405, 0, 0, 1",
        "0x049F, 0, 0, 3", "0x08180406, 0, 0x1F0000"})
    EXPECT_THAT(Worker(std::string("unlock\n enable\n pair 0, 0\n command ") + sequence).fault(),
                Tells(FlexspiProblem::wrong_steps))
        << sequence;
}

TEST(Flexspi, ItIsIdleWhenTheCommandIsDone) {
  Worker program(R"(
    unlock
    get FLEXSPI_STS0
    keep 0
    prepare 0x0406, 0, 0, 0
    set FLEXSPI_IPCMD, 1
    get FLEXSPI_STS0
    keep 1
    finish
    get FLEXSPI_STS0
    keep 2
    set FLEXSPI_INTR, 1
    get FLEXSPI_INTR
    keep 3
  )");
  EXPECT_EQ(program.outcome(), "");
  EXPECT_EQ(program.result(0), 3U);
  EXPECT_EQ(program.result(1), 0U);
  EXPECT_EQ(program.result(2), 3U);
  EXPECT_EQ(program.result(3) & 1, 0U) << "IPCMDDONE is cleared by a one";
}

TEST(Flexspi, ACommandWaitsForItsData) {
  Worker program(R"(
    unlock
    enable
    set FLEXSPI_IPTXFCR, 1
    prepare 0x08180402, 0x2001, 0x1F0000, 8
    set FLEXSPI_IPCMD, 1
    pause 100
    get FLEXSPI_INTR
    keep 0
    pair 0, 0
    finish
    movs r0, #1
    keep 1
  )");
  EXPECT_EQ(program.outcome(), "");
  EXPECT_EQ(program.result(0) & 1, 0U);
  EXPECT_EQ(program.result(1), 1U);
}

TEST(Flexspi, ItsQueueTakes128Bytes) {
  Worker full("unlock\n movs r5, #16\n1: pair 0, 0\n subs r5, #1\n bne 1b\n get FLEXSPI_INTR\n keep 0");
  EXPECT_EQ(full.outcome(), "");
  EXPECT_EQ(full.result(0) & 0x40, 0U) << "IPTXWE: no room";
  Worker more("unlock\n movs r5, #17\n1: pair 0, 0\n subs r5, #1\n bne 1b");
  EXPECT_THAT(more.fault(), Tells(FlexspiProblem::overrun));
}

TEST(Flexspi, AnswersStayUntilTheQueueIsCleared) {
  Worker program(R"(
    unlock
    status
    enable
    command 0x24010405, 0, 0, 1
    get FLEXSPI_RFDR0
    keep 0
    set FLEXSPI_IPRXFCR, 1
    command 0x24010405, 0, 0, 1
    get FLEXSPI_RFDR0
    keep 1
  )");
  EXPECT_EQ(program.outcome(), "");
  EXPECT_EQ(program.result(0) & 0xFF, 0U) << "the first answer";
  EXPECT_EQ(program.result(1) & 0xFF, 2U);
}

TEST(Flexspi, NothingIsReadFromAnEmptyQueue) {
  EXPECT_THAT(Worker("get FLEXSPI_RFDR0").fault(), Tells(FlexspiProblem::nothing_received));
}

}  // namespace
}  // namespace astro::emulator
