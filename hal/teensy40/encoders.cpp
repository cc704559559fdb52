#include "hal/teensy40/encoders.hpp"

#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/pins.hpp"

namespace astro::teensy40 {
namespace {

using Decoder = Peripheral<enc::Type>;

constexpr std::uint32_t kSamplePeriod_counts = 50;  // of 150 MHz
constexpr std::uint32_t kSamples = 8;

void route() {
  // Crossbar pins 6, 7, 8 and 17 are inputs; the bits of GPR6 would make them outputs.
  IOMUXC_GPR[iomuxc_gpr::GPR6].modify(
      iomuxc_gpr::GPR6_IOMUXC_XBAR_DIR_SEL_6.mask() | iomuxc_gpr::GPR6_IOMUXC_XBAR_DIR_SEL_7.mask() |
          iomuxc_gpr::GPR6_IOMUXC_XBAR_DIR_SEL_8.mask() | iomuxc_gpr::GPR6_IOMUXC_XBAR_DIR_SEL_17.mask(),
      0);
  // Outputs 66 and 67 are ENC1's phases A and B, 71 and 72 those of ENC2. Halfwords only: bytes do not work.
  XBARA1[xbara::SEL33].write(xbara::SEL33_SEL66(6) | xbara::SEL33_SEL67(7));
  XBARA1[xbara::SEL35].modify(xbara::SEL35_SEL71.mask(), xbara::SEL35_SEL71(8));
  XBARA1[xbara::SEL36].modify(xbara::SEL36_SEL72.mask(), xbara::SEL36_SEL72(17));
}

void begin(Decoder decoder) {
  decoder[enc::CTRL].write(0);
  decoder[enc::CTRL2].write(0);
  decoder[enc::FILT].write(0);  // the filter changes only while its period is 0
  decoder[enc::FILT].write(enc::FILT_FILT_CNT(kSamples - 3));
  decoder[enc::FILT].write(enc::FILT_FILT_CNT(kSamples - 3) | enc::FILT_FILT_PER(kSamplePeriod_counts));
  decoder[enc::UINIT].write(0);
  decoder[enc::LINIT].write(0);
  decoder[enc::UMOD].write(0);
  decoder[enc::LMOD].write(0);
  decoder[enc::UCOMP].write(0xFFFF);
  decoder[enc::LCOMP].write(0xFFFF);
  decoder[enc::CTRL].write(enc::CTRL_SWIP(1));
}

std::int32_t position(Decoder decoder) {
  while (true) {
    // Reading the live upper half latches both halves, but perhaps two bus clocks late. Then the halves are
    // of two instants, which shows in a different latched upper half.
    const std::uint32_t live = decoder[enc::UPOS].read();
    const std::uint32_t lower = decoder[enc::LPOSH].read();
    const std::uint32_t upper = decoder[enc::UPOSH].read();
    if (upper == live) return static_cast<std::int32_t>(upper << 16 | lower);
  }
}

}  // namespace

void Encoders::start() {
  open_gate(CCM[ccm::CCGR2], ccm::CCGR2_CG11);
  open_gate(CCM[ccm::CCGR4], ccm::CCGR4_CG12);
  open_gate(CCM[ccm::CCGR4], ccm::CCGR4_CG13);
  apply(kEncoderPins);
  route();
  begin(ENC1);
  begin(ENC2);
}

hal::EncoderCounts Encoders::read() noexcept {
  const std::int32_t left = position(ENC1), right = position(ENC2);
  return {left, right};
}

}  // namespace astro::teensy40
