#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstring>

#include "hal/teensy40/registers/registers.hpp"
#include "tests/host/emulator/program.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;
using support::Tells;
using testing::ElementsAre;
using testing::IsEmpty;

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kHeads = 0x2000'1000, kTransfer = 0x2000'2000, kBuffer = 0x2000'3000;

// Endpoint 0, and bulk endpoints: 2 from the host, 3 to the host and with an empty packet at the end. Packets
// of 64 bytes.
const std::string kMacrosAndClocks = R"(
  .macro transfer bytes, flags=0x8080
    set 0x20002000, 1
    set 0x20002004, (\bytes<<16)+\flags
    set 0x20002008, 0x20003000
    set 0x2000200C, 0x20004000
    set 0x20002010, 0x20005000
    set 0x20002014, 0x20006000
    set 0x20002018, 0x20007000
  .endm
  .macro prime endpoint, in, to=0x20002000, token=0
    set 0x20001008+64*(2*\endpoint+\in), \to
    set 0x2000100C+64*(2*\endpoint+\in), \token
    set USB1_ENDPTPRIME, 1<<(\endpoint+16*\in)
  .endm
    set CCM_CCGR6, 0xFFFFFFFF
    set CCM_ANALOG_PLL_USB1_SET, 0x3040
    set USBPHY1_CTRL_CLR, 0xC0000000
    set USBPHY1_PWD, 0
)";
const std::string kMode = "  set USB1_USBMODE, 2\n";
const std::string kList = R"(
    set 0x20001000, 0x00408000
    set 0x20001008, 1
    set 0x20001040, 0x20400000
    set 0x20001048, 1
    set 0x20001100, 0x20400000
    set 0x20001108, 1
    set 0x200011C0, 0x00400000
    set 0x200011C8, 1
    set USB1_ENDPTLISTADDR, 0x20001000
)";
const std::string kAttach = "  set USB1_USBCMD, 1\n";
const std::string kEndpoints = "  set USB1_ENDPTCTRL2, 0x000800C8\n  set USB1_ENDPTCTRL3, 0x00C80008\n";
const std::string kReady = kMacrosAndClocks + kMode + kList + kAttach + kEndpoints;

/// Attached and with its endpoints open, it has run `code` and stays there.
struct Device : Program {
  explicit Device(const std::string& code = "") : Program(kReady + code) { EXPECT_EQ(stopped_by(), ""); }
  UsbController& usb() { return teensy().usb(); }
  template <class Offset>
  std::uint32_t reg(Offset offset) {
    return usb().read(offset.value);
  }
  std::uint32_t token() { return teensy().word_at(kTransfer + 4); }
  Bytes buffer(std::size_t bytes) {
    const auto there = teensy().chip().memory().at(kBuffer, static_cast<std::uint32_t>(bytes));
    return {there.begin(), there.end()};
  }
};

Remark refusal_once_ready(const std::string& code) { return Program(kReady + code).fault(); }

// The host has seen the device; then it detaches.
constexpr const char* kLeave = "  set USB1_USBCMD, 0\n";

TEST(UsbController, ThatComesBackBeforeAHostHasNoticedEndsTheRun) {
  EXPECT_THAT(refusal_once_ready(kLeave + kAttach), Tells(UsbProblem::attached_again_too_soon));
  Program back(kReady + kLeave + "1: get 0x20000000\n cmp r0, #0\n beq 1b\n" + kAttach);
  EXPECT_EQ(back.stopped_by(), "");
  back.teensy().chip().wait(256'000 * kCyclesPerMicrosecond);  // the processor, not 150 million instructions
  back.teensy().chip().memory().at(Memory::kDtcm, 4)[0] = 1;
  EXPECT_EQ(back.stopped_by(), "");
  EXPECT_TRUE(back.teensy().usb().attached());
}

TEST(UsbController, ThatTheRomHasLeftAttachedIsTakenOffTheBusFirst) {
  const Program program("stay");
  Teensy teensy(program.hex(), {}, HandOver::untidy);
  teensy.usb().write(usb::USBMODE.value, 2);
  teensy.usb().write(usb::USBCMD.value, 1);
  EXPECT_THROW(teensy.run_for(1ms), Stopped);
}

TEST(UsbController, TheStepsOfTheManualAttachIt) {
  Device device;
  EXPECT_TRUE(device.usb().attached());
  EXPECT_EQ(device.reg(usb::PORTSC1) & 1, 1U) << "CCS";
}

TEST(UsbController, ItIsADeviceBeforeItIsAttached) {
  EXPECT_THAT(Program(kMacrosAndClocks + kList + kAttach).fault(),
              Tells(UsbProblem::attached_before_device_mode));
}

TEST(UsbController, ItIsNotAttachedWithoutItsClocks) {
  for (const char* missing : {"set CCM_ANALOG_PLL_USB1_CLR, 0x40", "set CCM_ANALOG_PLL_USB1_CLR, 0x1000",
                              "set CCM_ANALOG_PLL_USB1_CLR, 0x2000", "set CCM_ANALOG_PLL_USB1_SET, 0x10000",
                              "set CCM_ANALOG_PLL_USB1_SET, 2", "set USBPHY1_CTRL_SET, 0x40000000",
                              "set USBPHY1_CTRL_SET, 0x80000000", "set USBPHY1_PWD_SET, 0x400"})
    EXPECT_THAT(Program(kMacrosAndClocks + kMode + kList + missing + "\n" + kAttach).fault(),
                Tells(UsbProblem::attached_without_clock))
        << missing;
}

TEST(UsbController, ItIsNotAttachedWithoutQueueHeads) {
  EXPECT_THAT(Program(kMacrosAndClocks + kMode + kAttach).fault(),
              Tells(UsbProblem::attached_without_queue_heads));
}

TEST(UsbController, TheQueueHeadsAreAlignedTo2Kilobytes) {
  EXPECT_THAT(Program(kMacrosAndClocks + kMode + "  set USB1_ENDPTLISTADDR, 0x20001400").fault(),
              Tells(UsbProblem::queue_heads_misaligned));
}

TEST(UsbController, ACommandOfItsOwnResetsIt) {
  Device device("  set USB1_USBCMD, 2\n get USB1_USBCMD\n keep 0");
  EXPECT_FALSE(device.usb().attached());
  EXPECT_EQ(device.result(0) & 3, 0U);
  EXPECT_EQ(device.reg(usb::USBMODE), 0U);
  EXPECT_EQ(device.reg(usb::ENDPTCTRL0), 0x0080'0080U);
  EXPECT_EQ(device.reg(usb::ENDPTCTRL2), 0U);
}

TEST(UsbController, RegistersWithoutAModelAreRefused) {
  for (const char* name : {"GPTIMER0CTRL", "FRINDEX", "ENDPTNAKEN", "OTGSC"}) {
    const auto not_modelled = Tells(UsbProblem::not_modelled, std::string("USB1 ") + name);
    EXPECT_THAT(Program(kMacrosAndClocks + "  get USB1_" + name).fault(), not_modelled);
    EXPECT_THAT(Program(kMacrosAndClocks + "  set USB1_" + name + ", 1").fault(), not_modelled);
  }
  EXPECT_THAT(Program(kMacrosAndClocks + "  set USB1_PORTSC1, 0x01000000").fault(),
              Tells(UsbProblem::not_modelled, "USB1 PORTSC1"));
}

TEST(UsbPriming, NeedsTheDeviceMode) {
  EXPECT_THAT(Program(kMacrosAndClocks + kList + "  transfer 0\n prime 0, 1").fault(),
              Tells(UsbProblem::primed_before_device_mode));
}

TEST(UsbPriming, NeedsAnEnabledEndpoint) {
  EXPECT_THAT(refusal_once_ready("  transfer 0\n prime 4, 1"), Tells(UsbProblem::not_enabled, "4"));
  EXPECT_THAT(refusal_once_ready("  transfer 0\n prime 2, 1"), Tells(UsbProblem::not_enabled, "2"))
      << "the other direction is";
}

TEST(UsbPriming, NeedsATransferThatIsActiveAndAlone) {
  EXPECT_THAT(refusal_once_ready("  transfer 8\n prime 3, 1, 0x20002001"),
              Tells(EndpointProblem::no_transfer));
  EXPECT_THAT(refusal_once_ready("  transfer 8\n prime 3, 1, 0x20002010"),
              Tells(EndpointProblem::transfer_misaligned));
  EXPECT_THAT(refusal_once_ready("  transfer 8\n prime 3, 1, 0x20002000, 0x40"),
              Tells(EndpointProblem::head_halted));
  EXPECT_THAT(refusal_once_ready("  transfer 8, 0x8000\n prime 3, 1"),
              Tells(EndpointProblem::transfer_inactive));
  EXPECT_THAT(refusal_once_ready("  transfer 8\n set 0x20002000, 0x20002020\n prime 3, 1"),
              Tells(EndpointProblem::list_not_modelled));
}

TEST(UsbPriming, NeedsATransferThatTellsWhenItIsDone) {
  EXPECT_THAT(refusal_once_ready("  transfer 8, 0x80\n prime 3, 1"),
              Tells(EndpointProblem::no_interrupt_when_done));
}

TEST(UsbPriming, NeedsAPointerToEachPageOfTheBuffer) {
  const std::string crossing = "  transfer 0x1001\n set 0x2000200C, 0\n";
  EXPECT_THAT(refusal_once_ready(crossing + "  prime 3, 1"), Tells(EndpointProblem::pages_missing));
  EXPECT_EQ(refusal_once_ready("  transfer 0x1001\n prime 3, 1").sentence, "");
  EXPECT_EQ(refusal_once_ready("  transfer 0x1000\n set 0x2000200C, 0\n prime 3, 1").sentence, "")
      << "one page is enough";
  EXPECT_THAT(refusal_once_ready("  transfer 0x5001\n prime 3, 1"), Tells(EndpointProblem::pages_missing))
      << "five pages";
}

TEST(UsbPriming, FindsHeadsAndTransfersInRamAlone) {
  EXPECT_THAT(refusal_once_ready("  transfer 8\n prime 3, 1, 0x60002000"),
              Tells(ChipProblem::bus_master_outside_ram, "0x60002000"));
  EXPECT_THAT(refusal_once_ready("  set USB1_ENDPTLISTADDR, 0x60002000\n transfer 8\n prime 3, 1"),
              Tells(ChipProblem::bus_master_outside_ram, "0x600021C0"));
}

// The region 0x20200000, 512 KB, without a cache (TEX 1) or with one (C and B).
constexpr const char* kCaches = R"(
    set MPU_RNR, 0
    set MPU_RBAR, 0x20200000
    set MPU_RASR, {}
    set MPU_CTRL, 5
    set SCB_CCR, 0x30000
    set 0x20200000, 1
    set 0x20200004, 0x00088080
    set 0x20200008, 0x20003000
    prime 3, 1, 0x20200000
)";

TEST(UsbPriming, FindsStaleDataInMemoryThatTheProcessorCaches) {
  EXPECT_THAT(refusal_once_ready(fmt::format(kCaches, "0x03030025")),
              Tells(ChipProblem::bus_master_in_cached_memory, "0x20200000"));
  EXPECT_EQ(refusal_once_ready(fmt::format(kCaches, "0x03080025")).sentence, "");
}

TEST(UsbPriming, FindsStaleDataInOcramWithoutARegionToo) {
  EXPECT_THAT(refusal_once_ready(fmt::format(kCaches, "0x03080024")),
              Tells(ChipProblem::bus_master_in_cached_memory, "0x20200000"))
      << "the default map";
}

TEST(UsbPriming, FindsTheCoupledMemoriesAsTheyAre) {
  EXPECT_EQ(refusal_once_ready("  set SCB_CCR, 0x30000\n transfer 8\n prime 3, 1").sentence, "")
      << "they have no cache";
}

TEST(UsbPriming, IsShownUntilAFlushOrTheEnd) {
  Device device("  transfer 8\n prime 3, 1\n get USB1_ENDPTSTAT\n keep 0\n get USB1_ENDPTPRIME\n keep 1\n" +
                std::string("  set USB1_ENDPTFLUSH, 0xFFFFFFFF\n get USB1_ENDPTSTAT\n keep 2"));
  EXPECT_EQ(device.result(0), 1U << 19);
  EXPECT_EQ(device.result(1), 0U) << "over at once";
  EXPECT_EQ(device.result(2), 0U);
  EXPECT_EQ(device.usb().in(0, 3).handshake, Handshake::nak);
}

TEST(UsbEndpoints, TheDirectionWithoutUseIsNotLeftAsControl) {
  EXPECT_THAT(refusal_once_ready("  set USB1_ENDPTCTRL4, 0x00C80000"),
              Tells(EndpointProblem::unused_direction_is_control, "4"));
  EXPECT_THAT(refusal_once_ready("  set USB1_ENDPTCTRL5, 0x000000C8"),
              Tells(EndpointProblem::unused_direction_is_control, "5"));
}

TEST(UsbEndpoints, EndpointZeroIsAlwaysOpen) {
  Device device("  set USB1_ENDPTCTRL0, 0\n get USB1_ENDPTCTRL0\n keep 0");
  EXPECT_EQ(device.result(0), 0x0080'0080U);
}

TEST(UsbEndpoints, OneThatIsNotOpenDoesNotAnswer) {
  Device device;
  EXPECT_EQ(device.usb().in(0, 4).handshake, Handshake::nothing);
  EXPECT_EQ(device.usb().out(0, 4, Bytes{1}, false), Handshake::nothing);
}

TEST(UsbEndpoints, AStallIsAnsweredBothWays) {
  Device device("  set USB1_ENDPTCTRL2, 0x000800C9\n set USB1_ENDPTCTRL3, 0x00C90008");
  EXPECT_EQ(device.usb().out(0, 2, Bytes{1}, false), Handshake::stall);
  EXPECT_EQ(device.usb().in(0, 3).handshake, Handshake::stall);
}

TEST(UsbIn, APrimedTransferGoesOutAndIsRetired) {
  Device device("  set 0x20003000, 0x04030201\n transfer 4\n prime 3, 1");
  const Packet packet = device.usb().in(0, 3);
  EXPECT_EQ(packet.handshake, Handshake::ack);
  EXPECT_THAT(packet.bytes, ElementsAre(1, 2, 3, 4));
  EXPECT_FALSE(packet.data1);
  EXPECT_EQ(device.token() & 0x7FFF'0080, 0U) << "nothing left, not active";
  EXPECT_EQ(device.reg(usb::ENDPTCOMPLETE), 1U << 19);
  EXPECT_EQ(device.reg(usb::USBSTS) & 1, 1U) << "UI";
  EXPECT_EQ(device.usb().in(0, 3).handshake, Handshake::nak);
}

TEST(UsbIn, LongTransfersGoInPacketsWithAlternatingToggles) {
  Device device("  transfer 150\n prime 3, 1");
  const Packet first = device.usb().in(0, 3), second = device.usb().in(0, 3), third = device.usb().in(0, 3);
  EXPECT_EQ(first.bytes.size(), 64U);
  EXPECT_EQ(second.bytes.size(), 64U);
  EXPECT_EQ(third.bytes.size(), 22U);
  EXPECT_FALSE(first.data1);
  EXPECT_TRUE(second.data1);
  EXPECT_FALSE(third.data1);
  EXPECT_EQ(device.reg(usb::ENDPTCOMPLETE), 1U << 19);
}

TEST(UsbIn, WholePacketsAreFollowedByAnEmptyOneUnlessTheHeadForbidsIt) {
  Device with("  transfer 64\n prime 3, 1");
  EXPECT_EQ(with.usb().in(0, 3).bytes.size(), 64U);
  EXPECT_EQ(with.reg(usb::ENDPTCOMPLETE), 0U);
  const Packet empty = with.usb().in(0, 3);
  EXPECT_EQ(empty.handshake, Handshake::ack);
  EXPECT_THAT(empty.bytes, IsEmpty());
  EXPECT_EQ(with.reg(usb::ENDPTCOMPLETE), 1U << 19);

  Device without("  set 0x200011C0, 0x20400000\n transfer 64\n prime 3, 1");
  EXPECT_EQ(without.usb().in(0, 3).bytes.size(), 64U);
  EXPECT_EQ(without.reg(usb::ENDPTCOMPLETE), 1U << 19);
}

TEST(UsbOut, AShortPacketEndsTheTransferAndLeavesTheRest) {
  Device device("  transfer 512\n prime 2, 0");
  EXPECT_EQ(device.usb().out(0, 2, Bytes(64, 7), false), Handshake::ack);
  EXPECT_EQ(device.reg(usb::ENDPTCOMPLETE), 0U);
  EXPECT_EQ(device.usb().out(0, 2, Bytes{8, 9}, true), Handshake::ack);
  EXPECT_EQ(device.reg(usb::ENDPTCOMPLETE), 1U << 2);
  EXPECT_EQ(device.token() >> 16 & 0x7FFF, 512U - 66);
  EXPECT_EQ(device.buffer(66)[63], 7);
  EXPECT_EQ(device.buffer(66)[65], 9);
}

TEST(UsbOut, WithoutATransferTheHostIsToldToWait) {
  Device device;
  EXPECT_EQ(device.usb().out(0, 2, Bytes{1}, false), Handshake::nak);
}

TEST(UsbOut, ARepeatedPacketIsTakenAndForgotten) {
  Device device("  transfer 512\n prime 2, 0");
  EXPECT_EQ(device.usb().out(0, 2, Bytes(64, 7), false), Handshake::ack);
  EXPECT_EQ(device.usb().out(0, 2, Bytes(64, 8), false), Handshake::ack);
  EXPECT_EQ(device.buffer(128)[63], 7);
  EXPECT_EQ(device.buffer(128)[64], 0);
}

TEST(UsbOut, TheToggleBeginsAnewOnCommand) {
  Device device("  transfer 512\n prime 2, 0\n pause 1500\n set USB1_ENDPTCTRL2, 0x000800C8");
  EXPECT_EQ(device.usb().out(0, 2, Bytes(64, 7), false), Handshake::ack);
  EXPECT_EQ(device.stopped_by(), "");
  EXPECT_EQ(device.usb().out(0, 2, Bytes(64, 8), false), Handshake::ack);
  EXPECT_EQ(device.buffer(128)[64], 8);
}

TEST(UsbOut, APacketForABufferThatNoBusMasterReachesIsDroppedAndEndsTheRun) {
  for (const char* buffer : {"0x60003000", "0x10003000"}) {  // flash; nothing
    Device device(std::string("  transfer 512\n set 0x20002008, ") + buffer + "\n prime 2, 0");
    device.usb().out(0, 2, Bytes(64, 7), false);
    EXPECT_THAT(device.fault(), Tells(ChipProblem::bus_master_outside_ram, buffer));
    EXPECT_EQ(device.buffer(64), Bytes(64, 0));
  }
}

TEST(UsbOut, MoreThanTheTransferTakesEndsTheRun) {
  Device device("  transfer 8\n prime 2, 0");
  device.usb().out(0, 2, Bytes(9), false);
  EXPECT_THAT(device.fault(), Tells(UsbProblem::too_many_bytes, "2"));
}

constexpr std::array<std::uint8_t, 8> kSetup{0x80, 6, 0, 1, 0, 0, 18, 0};

TEST(UsbSetup, ThePacketLiesInTheHeadAndIsReported) {
  Device device;
  EXPECT_EQ(device.usb().setup(0, kSetup), Handshake::ack);
  EXPECT_EQ(device.teensy().word_at(kHeads + 40), 0x0100'0680U);
  EXPECT_EQ(device.teensy().word_at(kHeads + 44), 0x0012'0000U);
  EXPECT_EQ(device.reg(usb::ENDPTSETUPSTAT), 1U);
  EXPECT_EQ(device.reg(usb::USBSTS) & 1, 1U) << "UI";
}

TEST(UsbSetup, WithoutItsBitInTheHeadItRaisesNoInterrupt) {
  Device device("  set 0x20001000, 0x00400000");
  EXPECT_EQ(device.usb().setup(0, kSetup), Handshake::ack);
  EXPECT_EQ(device.reg(usb::ENDPTSETUPSTAT), 1U);
  EXPECT_EQ(device.reg(usb::USBSTS) & 1, 0U) << "UI";
}

TEST(UsbSetup, ItTripsTheWireAndEndsAStall) {
  Device device("  set USB1_ENDPTCTRL0, 0x00010001\n set USB1_USBCMD, 0x2001");
  EXPECT_EQ(device.usb().in(0, 0).handshake, Handshake::stall);
  device.usb().setup(0, kSetup);
  EXPECT_EQ(device.reg(usb::USBCMD) & 0x2000, 0U) << "SUTW";
  EXPECT_EQ(device.reg(usb::ENDPTCTRL0), 0x0080'0080U);
}

TEST(UsbSetup, UntilItIsTakenTheHostIsToldToWait) {
  Device device("  transfer 0\n prime 0, 1\n pause 1500\n set USB1_ENDPTSETUPSTAT, 1");
  device.usb().setup(0, kSetup);
  EXPECT_EQ(device.usb().in(0, 0).handshake, Handshake::nak);
  EXPECT_EQ(device.stopped_by(), "");
  const Packet packet = device.usb().in(0, 0);
  EXPECT_EQ(packet.handshake, Handshake::ack);
  EXPECT_TRUE(packet.data1) << "the first packet behind a SETUP";
}

TEST(UsbAddress, ANewOneHoldsFromTheStatusStageOn) {
  Device device("  set USB1_DEVICEADDR, 0x15000000\n transfer 0\n prime 0, 1");
  EXPECT_EQ(device.usb().in(10, 0).handshake, Handshake::nothing);
  EXPECT_EQ(device.usb().in(0, 0).handshake, Handshake::ack);
  EXPECT_EQ(device.usb().in(0, 0).handshake, Handshake::nothing);
  EXPECT_EQ(device.usb().in(10, 0).handshake, Handshake::nak);
  EXPECT_EQ(device.reg(usb::DEVICEADDR), 10U << 25);
}

TEST(UsbAddress, WithoutTheBitThatDelaysItItHoldsAtOnce) {
  Device device("  set USB1_DEVICEADDR, 0x14000000");
  EXPECT_EQ(device.usb().setup(0, kSetup), Handshake::nothing);
  EXPECT_EQ(device.usb().setup(10, kSetup), Handshake::ack);
}

TEST(UsbReset, BringsAddressZeroAndIsSeenInThePort) {
  Device device("  set USB1_DEVICEADDR, 0x14000000");
  device.usb().begin_reset();
  EXPECT_EQ(device.reg(usb::PORTSC1) & 0x100, 0x100U) << "PR";
  EXPECT_EQ(device.reg(usb::USBSTS) & 0x40, 0x40U) << "URI";
  EXPECT_EQ(device.usb().setup(0, kSetup), Handshake::nothing) << "while it lasts";
  device.usb().end_reset(true);
  EXPECT_EQ(device.reg(usb::PORTSC1) & 0x300, 0x200U) << "HSP";
  EXPECT_EQ(device.reg(usb::USBSTS) & 4, 4U) << "PCI";
  EXPECT_EQ(device.usb().setup(0, kSetup), Handshake::ack);
}

TEST(UsbReset, OneThatIsOverBeforeTheFlushLeavesADeviceThatDoesNotAnswer) {
  Device device("  transfer 8\n prime 3, 1");
  device.usb().begin_reset();
  device.usb().end_reset(true);
  EXPECT_EQ(device.stopped_by(), "");
  EXPECT_EQ(device.usb().setup(0, kSetup), Handshake::nothing);
}

TEST(UsbReset, OneThatIsOverBeforeTheFlushAsksForAResetOfTheController) {
  Device device("  transfer 8\n prime 3, 1\n pause 1500\n set USB1_ENDPTFLUSH, 0xFFFFFFFF\n prime 3, 1");
  device.usb().begin_reset();
  device.usb().end_reset(true);
  EXPECT_THAT(device.fault(), Tells(UsbProblem::primed_without_reset));
}

TEST(UsbReset, AFlushWhileItLastsIsInTime) {
  Device device("  transfer 8\n prime 3, 1\n pause 1500\n set USB1_ENDPTFLUSH, 0xFFFFFFFF");
  device.usb().begin_reset();
  EXPECT_EQ(device.stopped_by(), "");
  device.usb().end_reset(false);
  EXPECT_EQ(device.stopped_by(), "");
  EXPECT_EQ(device.reg(usb::PORTSC1) & 0x200, 0U) << "full speed";
}

TEST(UsbReset, SuspendAndResumeAreSeenInThePort) {
  Device device;
  device.usb().suspend();
  EXPECT_EQ(device.reg(usb::PORTSC1) & 0x80, 0x80U) << "SUSP";
  EXPECT_EQ(device.reg(usb::USBSTS) & 0x100, 0x100U) << "SLI";
  device.usb().resume();
  EXPECT_EQ(device.reg(usb::PORTSC1) & 0x80, 0U);
}

TEST(UsbInterrupt, ItComesForWhatIsEnabledAndUntilTheFlagIsCleared) {
  const std::string handler = R"(
    set NVIC_ISER0+12, 0x20000
  2: wfi
    b 2b
  handler 129
    get USB1_USBSTS
    keep 1
    set USB1_USBSTS, 0xFFFFFFFF
    get USB1_USBSTS
    count 0
    bx lr
  )";
  Device enabled("  set USB1_USBINTR, 0x40\n" + handler);
  enabled.usb().begin_reset();
  EXPECT_EQ(enabled.stopped_by(), "");
  EXPECT_EQ(enabled.result(0), 1U) << "once";
  EXPECT_EQ(enabled.result(1), 0x40U) << "URI";
  Device disabled("  set USB1_USBINTR, 1\n" + handler);
  disabled.usb().begin_reset();
  EXPECT_EQ(disabled.stopped_by(), "");
  EXPECT_EQ(disabled.result(0), 0U);
}

TEST(UsbPhy, CopiesOfItsRegistersSetAndClear) {
  Device device(R"(
    set USBPHY1_PWD_SET, 0x1400
    set USBPHY1_PWD_CLR, 0x400
    get USBPHY1_PWD
    keep 0
    set USBPHY1_PWD, 0
  )");
  EXPECT_EQ(device.result(0), 0x1000U);
}

}  // namespace
}  // namespace astro::emulator
