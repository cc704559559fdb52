#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using support::Tells;

const std::string kClocks = "  set CCM_CCGR2, 0xFFFFFFFF\n  set CCM_CCGR4, 0xFFFFFFFF\n";
const std::string kWired = kClocks + R"(
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_EMC_04, 3
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_EMC_05, 3
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_EMC_06, 3
    set IOMUXC_SW_MUX_CTL_PAD_GPIO_EMC_08, 3
    set16 XBARA1_SEL33, 0x0706
    set16 XBARA1_SEL35, 0x0800
    set16 XBARA1_SEL36, 0x0011
)";

/// Runs for a moment, then both shafts turn.
struct Turned : Program {
  Turned(const std::string& code, std::int32_t left, std::int32_t right) : Program(kWired + code) {
    teensy().run_for(10us);
    teensy().turn_shafts(left, right);
  }
};

TEST(Decoders, EachCountsTheEdgesOfItsOwnPins) {
  Turned program("pause 50\n get16 ENC1_LPOS\n keep 0\n get16 ENC2_LPOS\n keep 1", 40, 70);
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 40U);
  EXPECT_EQ(program.result(1), 70U);
}

TEST(Decoders, CountingBackwardsGoesThroughZero) {
  Turned program("pause 50\n get16 ENC1_UPOS\n keep 0\n get16 ENC1_LPOSH\n keep 1", -1, 0);
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 0xFFFFU);
  EXPECT_EQ(program.result(1), 0xFFFFU);
  EXPECT_EQ(program.teensy().encoder(0).position(), -1);
}

TEST(Decoders, AReversedOneCountsTheOtherWay) {
  Turned program("set16 ENC1_CTRL, 0x0400", 25, 25);
  EXPECT_EQ(program.teensy().encoder(0).position(), -25);
  EXPECT_EQ(program.teensy().encoder(1).position(), 25);
}

TEST(Decoders, EveryWireIsNeeded) {
  struct Case {
    const char* cut;
    std::int32_t left, right;
  };
  for (const Case& each :
       {Case{"set IOMUXC_SW_MUX_CTL_PAD_GPIO_EMC_04, 5", 0, 9},
        Case{"set IOMUXC_SW_MUX_CTL_PAD_GPIO_EMC_05, 5", 0, 9},
        Case{"set IOMUXC_SW_MUX_CTL_PAD_GPIO_EMC_06, 5", 9, 0},
        Case{"set IOMUXC_SW_MUX_CTL_PAD_GPIO_EMC_08, 5", 9, 0}, Case{"set16 XBARA1_SEL33, 0x0700", 0, 9},
        Case{"set16 XBARA1_SEL33, 0x0006", 0, 9}, Case{"set16 XBARA1_SEL35, 0", 9, 0},
        Case{"set16 XBARA1_SEL36, 0", 9, 0}, Case{"set IOMUXC_XBAR1_IN06_SELECT_INPUT, 1", 0, 9},
        Case{"set IOMUXC_XBAR1_IN17_SELECT_INPUT, 1", 9, 0}, Case{"set IOMUXC_GPR_GPR6, 0x00040000", 0, 9},
        Case{"set IOMUXC_GPR_GPR6, 0x20000000", 9, 0}}) {
    Turned program(each.cut, 9, 9);
    EXPECT_EQ(program.teensy().encoder(0).position(), each.left) << each.cut;
    EXPECT_EQ(program.teensy().encoder(1).position(), each.right) << each.cut;
  }
}

TEST(Decoders, ReadingEitherHalfHoldsBothAsTheyAreThen) {
  for (const char* live : {"ENC1_UPOS", "ENC1_LPOS"}) {
    Program program(kWired + "  pause 20\n get16 " + live + R"(
    keep 0
    pause 40
    get16 ENC1_UPOSH
    keep 1
    get16 ENC1_LPOSH
    keep 2
    get16 ENC1_UPOS
    keep 3
    )");
    program.teensy().run_for(10us);
    program.teensy().turn_shafts(0x0001'FFFF, 0);
    program.teensy().run_for(30us);
    program.teensy().turn_shafts(1, 0);
    EXPECT_EQ(program.stopped_by(), "");
    EXPECT_EQ(program.result(1), 0x0001U) << live;
    EXPECT_EQ(program.result(2), 0xFFFFU) << live;
    EXPECT_EQ(program.result(3), 0x0002U) << "live";
  }
}

TEST(Decoders, TheHeldHalvesStandStillWithoutARead) {
  Turned program("pause 50\n get16 ENC1_UPOSH\n keep 0\n get16 ENC1_LPOSH\n keep 1", 5, 0);
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 0U);
  EXPECT_EQ(program.result(1), 0U);
}

TEST(Decoders, TheInitialPositionIsLoadedOnCommandAlone) {
  Turned program(R"(
    pause 50
    set16 ENC1_UINIT, 0x1234
    set16 ENC1_LINIT, 0x5678
    get16 ENC1_LPOS
    keep 0
    set16 ENC1_CTRL, 0x0800
    get16 ENC1_UPOS
    keep 1
    get16 ENC1_LPOSH
    keep 2
    get16 ENC1_CTRL
    keep 3
  )",
                 5, 0);
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 5U);
  EXPECT_EQ(program.result(1), 0x1234U);
  EXPECT_EQ(program.result(2), 0x5678U);
  EXPECT_EQ(program.result(3), 0U) << "the command reads as 0";
}

TEST(Decoders, ThePositionCanBeWrittenByHalves) {
  Program program(kWired + "  set16 ENC1_UPOS, 0xABCD\n set16 ENC1_LPOS, 0x0123\n");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(static_cast<std::uint32_t>(program.teensy().encoder(0).position()), 0xABCD'0123U);
}

TEST(Decoders, FlagsInTheControlRegisterAreClearedByOnesAndNotSet) {
  Program program(kWired + "  set16 ENC1_CTRL, 0x8512\n get16 ENC1_CTRL\n keep 0");
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.result(0), 0x0400U);
}

TEST(Decoders, TheFilterChangesOnlyWhileItsPeriodIsZero) {
  EXPECT_THAT(Program(kClocks + "  set16 ENC2_FILT, 0x0532\n set16 ENC2_FILT, 0x0232").fault(),
              Tells(DecoderProblem::filter_running, "2"));
  Program program(kClocks + "  set16 ENC2_FILT, 0x0532\n set16 ENC2_FILT, 0\n set16 ENC2_FILT, 0x0232");
  EXPECT_EQ(program.stopped_by(), "");
}

TEST(Decoders, TheFilterDelaysByItsSamplesAndIsOffAfterAReset) {
  Program program(kClocks + "  set16 ENC1_FILT, 0x0532");
  EXPECT_EQ(program.teensy().encoder(0).filter_clocks(), 0U);
  EXPECT_EQ(program.stopped_by(), "");
  EXPECT_EQ(program.teensy().encoder(0).filter_clocks(), 8U * 50);
}

TEST(Decoders, CountingModuloIsRefused) {
  EXPECT_THAT(Program(kClocks + "  set16 ENC1_CTRL2, 4").fault(),
              Tells(DecoderProblem::modulo_not_modelled, "1"));
  EXPECT_EQ(Program(kClocks + "  set16 ENC1_UMOD, 0\n set16 ENC1_LMOD, 0").stopped_by(), "");
}

TEST(Decoders, DifferencesAndRevolutionsAreRefused) {
  EXPECT_THAT(Program(kClocks + "  get16 ENC1_POSD").fault(),
              Tells(DecoderProblem::read_not_modelled, "1", "POSD"));
  EXPECT_THAT(Program(kClocks + "  get16 ENC2_REV").fault(),
              Tells(DecoderProblem::read_not_modelled, "2", "REV"));
}

TEST(Decoders, TheHeldHalvesCannotBeWritten) {
  EXPECT_THAT(Program(kClocks + "  set16 ENC2_UPOSH, 1").fault(),
              Tells(DecoderProblem::write_not_modelled, "2", "0x12"));
}

TEST(Decoders, WhatIsWrittenReadsBack) {
  Program program(kClocks + R"(
    set16 ENC1_UCOMP, 0x1111
    set16 ENC1_LCOMP, 0x2222
    set16 ENC1_UINIT, 0x3333
    set16 ENC1_LINIT, 0x4444
    set16 ENC1_FILT, 0x0555
    set16 ENC1_CTRL2, 0x0002
    get16 ENC1_UCOMP
    keep 0
    get16 ENC1_LCOMP
    keep 1
    get16 ENC1_UINIT
    keep 2
    get16 ENC1_LINIT
    keep 3
    get16 ENC1_FILT
    keep 4
    get16 ENC1_CTRL2
    keep 5
  )");
  EXPECT_EQ(program.stopped_by(), "");
  const std::uint32_t expected[] = {0x1111, 0x2222, 0x3333, 0x4444, 0x0555, 0x0002};
  for (std::uint32_t n = 0; n < 6; ++n) EXPECT_EQ(program.result(n), expected[n]) << n;
}

TEST(Decoders, AnAccessByBytesIsRefused) {
  Program program(kClocks + "  ldr r6, =XBARA1_SEL33\n movs r7, #6\n strb r7, [r6]");
  EXPECT_THAT(program.fault(), Tells(AccessProblem::wrong_width, "XBARA1 SEL33", "write", "1"));
}

}  // namespace
}  // namespace astro::emulator
