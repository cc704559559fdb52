#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;
using testing::ElementsAre;
using testing::IsEmpty;

using Bytes = std::vector<std::uint8_t>;

// 1 Mbaud, so that a byte takes 10 us.
constexpr const char* kPads = R"(
    set CCM_CCGR3, 0xFFFFFFFF
    set CCM_CSCDR1, 0x06490B40     // 24 MHz
    set LPUART6_BAUD, 0x0B000002   // by 12, by 2
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_AD_B0_03, 2
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_AD_B0_02, 2
    set IOMUXC_LPUART6_RX_SELECT_INPUT, 1
)";
const std::string kQueues = std::string(kPads) + "  set LPUART6_FIFO, 0x88\n";
constexpr const char* kOn = "  set LPUART6_CTRL, 0x000C0000\n";

Program port(const std::string& code) { return Program(kQueues + kOn + code); }

Remark fault(Program& program, const Bytes& received) {
  program.teensy().run_for(10us);
  program.teensy().serial().send(received);
  return program.fault();
}

std::string stopped_by(Program& program, const Bytes& received) { return fault(program, received).sentence; }

TEST(Lpuart, TheRateIsTheClockByBothDividers) {
  Program program(kQueues);
  EXPECT_EQ(program.teensy().serial().baud(), 80'000'000U / 16 / 4) << "after a reset";
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.teensy().serial().baud(), 1'000'000U);
}

TEST(Lpuart, SentBytesTakeTheTimeOfTheRate) {
  Program program = port("set LPUART6_DATA, 1\n set LPUART6_DATA, 2\n set LPUART6_DATA, 3");
  program.teensy().run_for(25us);
  EXPECT_THAT(program.teensy().serial().receive(), ElementsAre(1, 2));
  program.teensy().run_for(10us);
  EXPECT_THAT(program.teensy().serial().receive(), ElementsAre(3));
}

TEST(Lpuart, ReceivedBytesTakeTheTimeOfTheRate) {
  Program program = port("1: get LPUART6_WATER\n lsrs r0, #24\n keep 0\n b 1b");
  program.teensy().run_for(10us);
  program.teensy().serial().send(Bytes{1, 2, 3});
  program.teensy().run_for(25us);
  EXPECT_EQ(program.result(0), 2U) << "RXCOUNT";
  EXPECT_EQ(program.teensy().serial().underway(), 1U);
  program.teensy().run_for(10us);
  EXPECT_EQ(program.result(0), 3U);
}

TEST(Lpuart, BytesComeInTheirOrder) {
  Program program = port("pause 50\n get LPUART6_DATA\n keep 0\n get LPUART6_DATA\n keep 1");
  EXPECT_EQ(stopped_by(program, {7, 8}), "");
  EXPECT_EQ(program.result(0), 7U);
  EXPECT_EQ(program.result(1), 8U);
}

TEST(Lpuart, TheReceiverFlagsMoreThanItsWatermark) {
  Program program(kQueues + "  set LPUART6_WATER, 0x00010000\n" + kOn + R"(
    pause 25
    get LPUART6_STAT
    keep 0
    pause 10
    get LPUART6_STAT
    keep 1
  )");
  EXPECT_EQ(stopped_by(program, {1, 2}), "");
  EXPECT_EQ(program.result(0) >> 21 & 1, 0U) << "RDRF, one byte";
  EXPECT_EQ(program.result(1) >> 21 & 1, 1U) << "RDRF, two bytes";
}

TEST(Lpuart, TheTransmitterAsksForMoreAtItsWatermark) {
  Program program(kQueues + "  set LPUART6_WATER, 1\n" + kOn + R"(
    set LPUART6_DATA, 1
    set LPUART6_DATA, 2
    get LPUART6_STAT
    keep 0
    pause 11
    get LPUART6_STAT
    keep 1
    pause 11
    get LPUART6_STAT
    keep 2
  )");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0) >> 22 & 3, 0U) << "two bytes wait";
  EXPECT_EQ(program.result(1) >> 22 & 3, 2U) << "TDRE";
  EXPECT_EQ(program.result(2) >> 22 & 3, 3U) << "TDRE and TC";
}

TEST(Lpuart, ALineThatFallsSilentIsFlaggedUntilTheFlagIsCleared) {
  Program program = port(R"(
    pause 25
    get LPUART6_STAT
    keep 0
    pause 10
    get LPUART6_STAT
    keep 1
    set LPUART6_STAT, 0x00100000
    get LPUART6_STAT
    keep 2
  )");
  EXPECT_EQ(stopped_by(program, {1}), "");
  EXPECT_EQ(program.result(0) >> 20 & 1, 0U);
  EXPECT_EQ(program.result(1) >> 20 & 1, 1U) << "IDLE";
  EXPECT_EQ(program.result(2) >> 20 & 1, 0U);
}

TEST(Lpuart, AClearedSilenceIsNotFlaggedAgainBeforeANewCharacter) {
  Program program = port(R"(
    until LPUART6_STAT, 0x00100000, 0x00100000
    set LPUART6_STAT, 0x00100000
    pause 100
    get LPUART6_STAT
    keep 0
    until LPUART6_STAT, 0x00100000, 0x00100000
    keep 1
  )");
  EXPECT_EQ(stopped_by(program, {1}), "");
  EXPECT_EQ(program.result(0) >> 20 & 1, 0U);
  EXPECT_EQ(program.result(1), 0U) << "it still waits";
  program.teensy().serial().send(Bytes{2});
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_NE(program.result(1), 0U);
}

// One byte is below the watermark: only the idle line reports it.
const std::string kBySilence = kQueues + "  set LPUART6_WATER, 0x00010000\n  set LPUART6_CTRL, 0x001C0000\n";

TEST(Lpuart, ACharacterThatNothingTellsOfEndsTheRun) {
  Program program(kBySilence + R"(
    until LPUART6_STAT, 0x00100000, 0x00100000
    set LPUART6_STAT, 0x00100000
  )");
  EXPECT_EQ(stopped_by(program, {1}), "") << "it may still be read";
  EXPECT_THAT(program.fault(), Tells(LpuartProblem::character_never_reported));
}

TEST(Lpuart, ACharacterThatIsReadAfterItsSilenceWasClearedIsNoFault) {
  Program program(kBySilence + R"(
    until LPUART6_STAT, 0x00100000, 0x00100000
    set LPUART6_STAT, 0x00100000
    get LPUART6_DATA
  )");
  EXPECT_EQ(stopped_by(program, {1}), "");
  EXPECT_EQ(program.stopped_by(), "");
}

TEST(Lpuart, ABusThatOthersUseMakesTheProcessorWait) {
  Program program = port("get LPUART6_STAT\n get LPUART6_STAT");
  program.teensy().serial().read_takes = 20 * kCyclesPerMicrosecond;
  program.teensy().run_for(10us);  // a block of instructions runs to its end
  EXPECT_GE(program.teensy().now_us(), 40U);
}

TEST(Lpuart, EachEventHasItsInterrupt) {
  struct Case {
    const char *name, *control;
  };
  for (const Case& each : {Case{"RIE", "0x002C0000"}, Case{"ILIE", "0x001C0000"}, Case{"TIE", "0x008C0000"},
                           Case{"TCIE", "0x004C0000"}}) {
    Program program(kQueues + R"(
    set NVIC_ISER0, 0x02000000
    set LPUART6_CTRL, )" +
                    each.control + R"(
    stay
  handler 41
    movs r0, #1
    keep 0
    stay
    )");
    EXPECT_EQ(stopped_by(program, {1}), "");
    EXPECT_EQ(program.result(0), 1U) << each.name;
  }
}

TEST(Lpuart, WithoutAnEnabledEventThereIsNoInterrupt) {
  Program program(kQueues + "  set NVIC_ISER0, 0x02000000\n" + kOn);
  EXPECT_EQ(stopped_by(program, {1}), "");
  EXPECT_EQ(program.result(15), 0U);
}

TEST(Lpuart, AByteThatFindsTheReceiversQueueFullEndsTheRun) {
  Program four = port("stay");
  EXPECT_EQ(stopped_by(four, {1, 2, 3, 4}), "");
  Program five = port("stay");
  EXPECT_THAT(fault(five, {1, 2, 3, 4, 5}), Tells(LpuartProblem::receiver_overrun));
}

TEST(Lpuart, WithoutItsQueueTheReceiverHoldsOneByte) {
  Program one(std::string(kPads) + kOn);
  EXPECT_EQ(stopped_by(one, {1}), "");
  Program two(std::string(kPads) + kOn);
  EXPECT_THAT(fault(two, {1, 2}), Tells(LpuartProblem::receiver_overrun));
}

TEST(Lpuart, AByteThatFindsTheTransmittersQueueFullEndsTheRun) {
  EXPECT_EQ(port(".rept 4\n set LPUART6_DATA, 1\n .endr").stopped_by(), "");
  EXPECT_THAT(port(".rept 5\n set LPUART6_DATA, 1\n .endr").fault(),
              Tells(LpuartProblem::transmitter_overrun));
}

TEST(Lpuart, WithoutItsQueueTheTransmitterHoldsOneByte) {
  Program program(std::string(kPads) + kOn + "  set LPUART6_DATA, 1\n set LPUART6_DATA, 2");
  EXPECT_THAT(program.fault(), Tells(LpuartProblem::transmitter_overrun));
}

TEST(Lpuart, AReceiverThatIsOffLosesBytes) {
  Program program(kQueues + "  set LPUART6_CTRL, 0x00080000\n pause 100\n get LPUART6_WATER\n keep 0");
  EXPECT_EQ(stopped_by(program, {1, 2, 3, 4, 5}), "");
  EXPECT_EQ(program.result(0), 0U);
}

TEST(Lpuart, ATransmitterThatIsOffTakesNothing) {
  EXPECT_THAT(Program(kQueues + "  set LPUART6_DATA, 1").fault(), Tells(LpuartProblem::transmitter_off));
}

TEST(Lpuart, NothingIsReadFromAnEmptyQueue) {
  EXPECT_THAT(port("get LPUART6_DATA").fault(), Tells(LpuartProblem::nothing_received));
}

TEST(Lpuart, ItIsConfiguredWhileBothHalvesAreOff) {
  for (const char* write : {"LPUART6_BAUD, 0x0B000002", "LPUART6_FIFO, 0x88", "LPUART6_WATER, 0"})
    for (const char* half : {"0x00080000", "0x00040000"})
      EXPECT_THAT(Program(kQueues + "  set LPUART6_CTRL, " + half + "\n  set " + write).fault(),
                  Tells(LpuartProblem::running))
          << write;
}

TEST(Lpuart, FewSamplesABitNeedBothEdges) {
  EXPECT_THAT(Program(kQueues + "  set LPUART6_BAUD, 0x05000001").fault(),
              Tells(LpuartProblem::too_few_samples, "6"));
  EXPECT_THAT(Program(kQueues + "  set LPUART6_BAUD, 0x02020001").fault(),
              Tells(LpuartProblem::too_few_samples, "3"));
  EXPECT_EQ(Program(kQueues + "  set LPUART6_BAUD, 0x05020001").stopped_by(), "");
}

TEST(Lpuart, ADividerOfZeroStopsThePort) {
  Program program(kQueues +
                  "  set LPUART6_BAUD, 0x0B000000\n  set LPUART6_CTRL, 0x000C0000\n set LPUART6_DATA, 1");
  EXPECT_THAT(program.fault(), Tells(LpuartProblem::divider_zero));
}

TEST(Lpuart, BytesGoNowhereUntilBothPadsAndTheInputAreThePorts) {
  for (const char* wrong :
       {"set IOMUXC_SW_MUX_CTL_PAD_GPIO_AD_B0_03, 5", "set IOMUXC_SW_MUX_CTL_PAD_GPIO_AD_B0_02, 5",
        "set IOMUXC_LPUART6_RX_SELECT_INPUT, 0"}) {
    Program program =
        port(std::string(wrong) + "\n set LPUART6_DATA, 1\n pause 100\n get LPUART6_WATER\n keep 0");
    EXPECT_EQ(stopped_by(program, {1, 2, 3, 4, 5}), "");
    EXPECT_THAT(program.teensy().serial().receive(), IsEmpty()) << wrong;
    EXPECT_EQ(program.result(0), 0U) << wrong;
  }
}

TEST(Lpuart, AFlushEmptiesTheQueues) {
  Program program = port(R"(
    set LPUART6_DATA, 1
    set LPUART6_DATA, 2
    pause 30
    set LPUART6_DATA, 3
    set LPUART6_CTRL, 0
    set LPUART6_FIFO, 0x0000C088
    get LPUART6_WATER
    keep 0
    get LPUART6_FIFO
    keep 1
  )");
  program.teensy().serial().send(Bytes{1, 2});
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 0U) << "RXCOUNT and TXCOUNT";
  EXPECT_EQ(program.result(1) & 0xC088, 0x88U) << "the flush bits read as 0";
  EXPECT_THAT(program.teensy().serial().receive(), ElementsAre(1, 2));
}

TEST(Lpuart, AHeldWireKeepsWhatIsSent) {
  Program program = port("set LPUART6_DATA, 1\n pause 100\n get LPUART6_WATER\n keep 0");
  program.teensy().serial().hold_wire(true);
  EXPECT_EQ(program.stopped_by(200us), "");
  EXPECT_EQ(program.result(0) >> 8 & 7, 1U) << "TXCOUNT";
  program.teensy().serial().hold_wire(false);
  program.teensy().run_for(20us);
  EXPECT_THAT(program.teensy().serial().receive(), ElementsAre(1));
}

TEST(Lpuart, TheSizesOfItsQueuesAreFour) {
  Program program = port("get LPUART6_PARAM\n keep 0");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 0x0202U) << "powers of two";
}

}  // namespace
}  // namespace astro::emulator
