#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

// 400 kHz from the crystal.
const std::string kI2cPads = R"(
    set CCM_CCGR2, 0xFFFFFFFF
    set CCM_CSCDR2, 0x00040000
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_AD_B1_00, 0x13
    set IOMUXC_SW_PAD_CTL_PAD_GPIO_AD_B1_00, 0x1F860
    set IOMUXC_LPI2C1_SCL_SELECT_INPUT, 1
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_AD_B1_01, 0x13
    set IOMUXC_SW_PAD_CTL_PAD_GPIO_AD_B1_01, 0x1F860
    set IOMUXC_LPI2C1_SDA_SELECT_INPUT, 1
)";
const std::string kI2cTiming = R"(
    set LPI2C1_MCFGR2, 0x02020E10
    set LPI2C1_MCCR0, 0x0C121421
)";
const std::string kI2cOn = kI2cPads + kI2cTiming + "  set LPI2C1_MCR, 1\n";
// WHO_AM_I of the FXAS21002C at 0x21.
const std::string kAskIdentity = R"(
    set LPI2C1_MTDR, 0x442
    set LPI2C1_MTDR, 0x00C
    set LPI2C1_MTDR, 0x443
    set LPI2C1_MTDR, 0x100
)";
const std::string kWriteToChip = "  set LPI2C1_MTDR, 0x442\n";

/// A program with the chip at its bus, which is not turning.
class WithChip {
 public:
  explicit WithChip(const std::string& code) : program(code) {
    chip_ = std::make_unique<Fxas21002c>(program.teensy().chip(), [] { return std::array{0.0, 0.0, 1.0}; });
    program.teensy().i2c().devices = {chip_.get()};
    program.teensy().run_for(1us);
  }
  Program program;

 private:
  std::unique_ptr<Fxas21002c> chip_;
};

constexpr auto kLongEnough = 5ms;
const std::string kChipStarts = "  pause 1500\n";

TEST(Lpi2c, ReadsARegisterOfAChipAndStops) {
  WithChip bus(kI2cOn + kChipStarts + kAskIdentity + R"(
    until LPI2C1_MSR, 2, 2
    get LPI2C1_MRDR
    keep 0
    set LPI2C1_MTDR, 0x200
    until LPI2C1_MSR, 0x200, 0x200
    get LPI2C1_MSR
    keep 1
  )");
  EXPECT_EQ(bus.program.stopped_by(kLongEnough), "");
  EXPECT_EQ(bus.program.result(0), 0xD7U);
  EXPECT_EQ(bus.program.result(1) & 0x0300'3C00U, 0U) << "an error, or the bus is still busy";
}

TEST(Lpi2c, TakesTheTimeOfItsBits) {
  WithChip bus(kI2cOn + kChipStarts + R"(
    movs r5, #0
  )" + kAskIdentity +
               R"(
  1: adds r5, #1
    get LPI2C1_MSR
    lsrs r0, #2
    bcc 1b
    mov r0, r5
    keep 0
  )");
  EXPECT_EQ(bus.program.stopped_by(kLongEnough), "");
  // Two addresses of ten bits with their starts, and two bytes of nine; a bit is 34 + 21 + 4 clocks of 24 MHz. A round of the loop
  // is five instructions of 1/600 us, and a few more stand around it.
  EXPECT_NEAR(bus.program.result(0) * 5 / 600.0, 38 * 59 / 24.0, 0.1);
}

TEST(Lpi2c, ToldThatNobodyAnswersItStopsByItself) {
  WithChip bus(kI2cOn + kChipStarts + R"(
    set LPI2C1_MTDR, 0x440
    pause 100
    get LPI2C1_MSR
    keep 0
  )");
  EXPECT_EQ(bus.program.stopped_by(kLongEnough), "");
  EXPECT_EQ(bus.program.result(0) & 0x0300'0600U, 0x0600U) << "NDF and SDF, and the bus is free";
}

TEST(Lpi2c, AClockThatIsHeldStopsEverythingUntilItIsLetGo) {
  WithChip bus(kI2cOn + kChipStarts + kAskIdentity + "  until LPI2C1_MSR, 2, 2\n  movs r0, #1\n  keep 0\n");
  bus.program.teensy().i2c().hold_clock(true);
  bus.program.teensy().run_for(4ms);
  EXPECT_EQ(bus.program.result(0), 0U);
  bus.program.teensy().i2c().hold_clock(false);
  EXPECT_EQ(bus.program.stopped_by(kLongEnough), "");
  EXPECT_EQ(bus.program.result(0), 1U);
}

TEST(Lpi2c, ADataLineThatIsHeldIsFreedByClocksOfThePins) {
  const std::string clock = "  set GPIO1_GDIR, 0x10000\n  pause 5\n  set GPIO1_GDIR, 0\n  pause 5\n";
  WithChip bus(kI2cOn + kChipStarts +
               "  set IOMUXC_SW_MUX_CTL_PAD_GPIO_AD_B1_00, 0x15\n  get GPIO1_PSR\n  keep 0\n" + clock +
               clock + "  get GPIO1_PSR\n  keep 1\n" + clock + "  get GPIO1_PSR\n  keep 2\n");
  bus.program.teensy().i2c().hold_data(3);
  EXPECT_EQ(bus.program.stopped_by(kLongEnough), "");
  constexpr std::uint32_t kData = 1U << 17;
  EXPECT_EQ(bus.program.result(0) & kData, 0U);
  EXPECT_EQ(bus.program.result(1) & kData, 0U);
  EXPECT_EQ(bus.program.result(2) & kData, kData);
}

TEST(Lpi2c, WhatItsDriverMayNotDoEndsTheRun) {
  struct Case {
    std::string code;
    Lpi2cProblem problem;
  };
  for (const Case& one : {
           Case{kI2cOn + "  set LPI2C1_MCCR0, 0x0C121421\n", Lpi2cProblem::running},
           Case{kI2cPads + kI2cTiming + kWriteToChip, Lpi2cProblem::off},
           Case{kI2cOn + kWriteToChip +
                    "  set LPI2C1_MTDR, 1\n set LPI2C1_MTDR, 2\n set LPI2C1_MTDR, 3\n set LPI2C1_MTDR, 4\n"
                    " set LPI2C1_MTDR, 5\n",
                Lpi2cProblem::queue_full},
           Case{kI2cOn + "  get LPI2C1_MRDR\n", Lpi2cProblem::nothing_received},
           Case{kI2cOn + "  set LPI2C1_MTDR, 0x00C\n", Lpi2cProblem::no_start},
           Case{"  set CCM_CCGR2, 0xFFFFFFFF\n set CCM_CSCDR2, 0x00040000\n" + kI2cTiming +
                    "  set LPI2C1_MCR, 1\n" + kWriteToChip,
                Lpi2cProblem::not_connected},
           Case{kI2cOn + "  set IOMUXC_SW_PAD_CTL_PAD_GPIO_AD_B1_01, 0x1F060\n" + kWriteToChip,
                Lpi2cProblem::not_open_drain},
           Case{
               kI2cPads + kI2cTiming + "  set LPI2C1_MCCR0, 0x04070A10\n  set LPI2C1_MCR, 1\n" + kWriteToChip,
               Lpi2cProblem::too_fast},
           Case{
               kI2cPads + kI2cTiming + "  set LPI2C1_MCCR0, 0x0C12281A\n  set LPI2C1_MCR, 1\n" + kWriteToChip,
               Lpi2cProblem::low_too_short},
           Case{kI2cOn + "  set LPI2C1_MTDR, 0x440\n  set LPI2C1_MTDR, 0x00C\n  pause 100\n  set LPI2C1_MSR, "
                         "0x7F00\n",
                Lpi2cProblem::left_in_queue},
           Case{kI2cOn + "  set GPIO1_DR_SET, 0x20000\n  set GPIO1_GDIR, 0x20000\n",
                Lpi2cProblem::not_open_drain},
       }) {
    Program program(one.code);
    EXPECT_THAT(program.fault(kLongEnough), Tells(one.problem)) << one.code;
  }
}

TEST(Lpi2c, IsNotThereWithoutItsClock) {
  Program program("  get LPI2C1_MSR\n");
  EXPECT_THAT(program.fault(kLongEnough), Tells(AccessProblem::clock_off, testing::_, testing::_, "2", "3"));
}

/// Writes bytes to the chip, the number of a register first.
std::string sent_to_chip(std::initializer_list<int> bytes) {
  std::string code = kWriteToChip;
  for (const int byte : bytes) code += "  set LPI2C1_MTDR, " + std::to_string(byte) + "\n";
  return code + "  set LPI2C1_MTDR, 0x200\n  until LPI2C1_MSR, 0x200, 0x200\n  set LPI2C1_MSR, 0x300\n";
}

TEST(GyroChip, IsSetUpInStandbyOnlyAndKnowsItsRegisters) {
  {
    WithChip bus(kI2cOn + kChipStarts + sent_to_chip({0x13, 0x02}) + sent_to_chip({0x0D, 0x82}));
    EXPECT_THAT(bus.program.fault(kLongEnough), Tells(SensorProblem::changed_while_active, "0x0D", "0x82"));
  }
  {
    WithChip bus(kI2cOn + kChipStarts + sent_to_chip({0x20, 0x02}));
    EXPECT_THAT(bus.program.fault(kLongEnough), Tells(SensorProblem::unknown_register, "0x20", "0x02"));
  }
}

TEST(GyroChip, DoesNotAcknowledgeItsReset) {
  WithChip bus(kI2cOn + kChipStarts + kWriteToChip + R"(
    set LPI2C1_MTDR, 0x13
    set LPI2C1_MTDR, 0x40
    pause 100
    get LPI2C1_MSR
    keep 0
  )");
  EXPECT_EQ(bus.program.stopped_by(kLongEnough), "");
  EXPECT_NE(bus.program.result(0) & 0x0400U, 0U);
}

TEST(GyroChip, MeasuresWithTheScaleThatItIsSetTo) {
  WithChip bus(kI2cOn + kChipStarts + sent_to_chip({0x0D, 0x82}) + sent_to_chip({0x13, 0x02}) + R"(
    set LPI2C1_MTDR, 0x442
    set LPI2C1_MTDR, 5
    set LPI2C1_MTDR, 0x443
    set LPI2C1_MTDR, 0x101
    until LPI2C1_MSR, 2, 2
    get LPI2C1_MRDR
    keep 0
    until LPI2C1_MSR, 2, 2
    get LPI2C1_MRDR
    keep 1
  )");
  EXPECT_EQ(bus.program.stopped_by(kLongEnough), "");
  const double one_radps = 180 / 3.141592653589793 / 0.015625;
  EXPECT_EQ(256 * bus.program.result(0) + bus.program.result(1), std::lround(one_radps));
}

}  // namespace
}  // namespace astro::emulator
