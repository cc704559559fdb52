#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

const std::string kPin = R"(
    set CCM_CCGR1, 0xFFFFFFFF
    set IOMUXC_SW_PAD_CTL_PAD_GPIO_AD_B1_02, 0x30
)";
const std::string kCalibrated = kPin + R"(
    set ADC1_CFG, 0x073B
    set ADC1_GC, 0x80
    until ADC1_GC, 0x80, 0
)";
constexpr const char* kConvert = R"(
    set ADC1_HC0, 7
    until ADC1_HS, 1, 1
    get ADC1_R0
    keep 0
)";
constexpr auto kLong = 3ms;

double expected(double battery_V) {
  return std::min(4095.0, std::round(battery_V * 10 / (82 + 10) / 3.3 * 4095));
}

TEST(Adc, ItReadsTheBatteryBehindItsDivider) {
  Program program(kCalibrated + kConvert);
  EXPECT_EQ(program.stopped_by(kLong), "");
  EXPECT_NEAR(program.result(0), expected(program.teensy().world().drivetrain().bus_V()), 1);
  EXPECT_GT(program.result(0), 1000U);
}

TEST(Adc, AVoltageBeyondItsReferenceReadsAsAllOnes) {
  Program program(kCalibrated + "  pause 1000\n" + kConvert);
  program.teensy().world().set_supply_V(47.0);
  EXPECT_EQ(program.stopped_by(kLong), "");
  EXPECT_EQ(program.result(0), 4095U);
}

TEST(Adc, ReadingTheResultTakesItsFlagBack) {
  Program program(kCalibrated + kConvert + "  get ADC1_HS\n keep 1");
  EXPECT_EQ(program.stopped_by(kLong), "");
  EXPECT_EQ(program.result(1), 0U);
}

TEST(Adc, AveragingTakesTheTimeOfItsSamples) {
  const std::string turns = R"(
    movs r5, #0
    set ADC1_HC0, 7
  1: adds r5, #1
    get ADC1_HS
    cmp r0, #0
    beq 1b
    mov r0, r5
    keep 0
  )";
  Program one(kCalibrated + turns);
  EXPECT_EQ(one.stopped_by(kLong), "");
  Program many(kCalibrated + "  set ADC1_CFG, 0xC73B\n set ADC1_GC, 0x20\n" + turns);
  EXPECT_EQ(many.stopped_by(kLong), "");
  EXPECT_NEAR(static_cast<double>(many.result(0)) / one.result(0), 32.0, 0.5);
}

TEST(Adc, TheCalibrationBitStaysUntilItIsDone) {
  Program program(kPin + "  set ADC1_CFG, 0x073B\n set ADC1_GC, 0x80\n get ADC1_GC\n keep 0\n pause 1100\n" +
                  "  get ADC1_GC\n keep 1\n get ADC1_GS\n keep 2");
  EXPECT_EQ(program.stopped_by(kLong), "");
  EXPECT_EQ(program.result(0), 0x80U);
  EXPECT_EQ(program.result(1), 0U);
  EXPECT_EQ(program.result(2), 0U) << "CALF";
}

TEST(Adc, AConversionBeforeTheCalibrationIsRefused) {
  EXPECT_THAT(Program(kPin + "  set ADC1_CFG, 0x073B\n set ADC1_HC0, 7").fault(),
              Tells(AdcProblem::not_calibrated));
  EXPECT_THAT(Program(kPin + "  set ADC1_CFG, 0x073B\n set ADC1_GC, 0x80\n set ADC1_HC0, 7").fault(),
              Tells(AdcProblem::not_calibrated));
}

TEST(Adc, AResetForgetsTheCalibration) {
  Program program(kPin + R"(
    get SRC_SRSR
    tst r0, #8
    bne 1f
    set ADC1_CFG, 0x073B
    set ADC1_GC, 0x80
    stay
  1: set ADC1_CFG, 0x073B
    set ADC1_HC0, 7
  )");
  program.teensy().run_for(kLong);
  program.teensy().press_reset();
  EXPECT_THAT(program.fault(), Tells(AdcProblem::not_calibrated));
}

TEST(Adc, TheKeeperOfThePadMustBeOff) {
  EXPECT_THAT(Program(kCalibrated + "  set IOMUXC_SW_PAD_CTL_PAD_GPIO_AD_B1_02, 0x10B0\n set ADC1_HC0, 7")
                  .fault(kLong),
              Tells(AdcProblem::keeper_on));
}

TEST(Adc, TheKeeperIsOnAfterAReset) {
  Program program(R"(
    set CCM_CCGR1, 0xFFFFFFFF
    set ADC1_CFG, 0x073B
    set ADC1_GC, 0x80
    until ADC1_GC, 0x80, 0
    set ADC1_HC0, 7
  )");
  EXPECT_THAT(program.fault(kLong), Tells(AdcProblem::keeper_on));
}

TEST(Adc, NothingIsConnectedToOtherChannels) {
  EXPECT_THAT(Program(kCalibrated + "  set ADC1_HC0, 8").fault(kLong), Tells(AdcProblem::not_connected));
  EXPECT_EQ(Program(kCalibrated + "  set ADC1_HC0, 31").stopped_by(kLong), "") << "off";
}

TEST(Adc, SwitchedOffItEndsTheConversionUnderWay) {
  Program program(kCalibrated + "  set ADC1_HC0, 7\n set ADC1_HC0, 31\n pause 10\n get ADC1_HS\n keep 0\n" +
                  kConvert);
  program.teensy().run_for(1'005us);
  EXPECT_EQ(program.result(0), 0U);
  EXPECT_EQ(program.stopped_by(), "") << "and another one may begin";
  EXPECT_GT(program.result(0), 1000U);
}

TEST(Adc, AConversionIsNotBegunWhileAnotherOneRuns) {
  EXPECT_THAT(Program(kCalibrated + "  set ADC1_HC0, 7\n set ADC1_HC0, 7").fault(kLong),
              Tells(AdcProblem::busy));
}

TEST(Adc, OtherResolutionsAreRefusedTheOneAfterAResetIncluded) {
  const std::string calibrate = "  set ADC1_GC, 0x80\n until ADC1_GC, 0x80, 0\n";
  EXPECT_THAT(Program(kPin + calibrate + "  set ADC1_HC0, 7").fault(kLong),
              Tells(AdcProblem::resolution_not_modelled));
  EXPECT_THAT(Program(kPin + "  set ADC1_CFG, 0x0737\n" + calibrate + "  set ADC1_HC0, 7").fault(kLong),
              Tells(AdcProblem::resolution_not_modelled));
}

}  // namespace
}  // namespace astro::emulator
