#include "host/emulator/chip/decoders.hpp"

#include <fmt/format.h>

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kFlags =
    enc::CTRL_CMPIRQ.mask() | enc::CTRL_DIRQ.mask() | enc::CTRL_XIRQ.mask() | enc::CTRL_HIRQ.mask();

/// How a pad is connected to an input of the crossbar, and which output leads to the decoder.
struct Wire {
  std::uint32_t mux, select, choice, input, output;
};
constexpr std::array<std::array<Wire, 2>, 2> kWires{{
    {{{iomuxc::SW_MUX_CTL_PAD_GPIO_EMC_04.value, iomuxc::XBAR1_IN06_SELECT_INPUT.value, 0, 6, 66},
      {iomuxc::SW_MUX_CTL_PAD_GPIO_EMC_05.value, iomuxc::XBAR1_IN07_SELECT_INPUT.value, 0, 7, 67}}},
    {{{iomuxc::SW_MUX_CTL_PAD_GPIO_EMC_06.value, iomuxc::XBAR1_IN08_SELECT_INPUT.value, 0, 8, 71},
      {iomuxc::SW_MUX_CTL_PAD_GPIO_EMC_08.value, iomuxc::XBAR1_IN17_SELECT_INPUT.value, 0, 17, 72}}},
}};

}  // namespace

bool EncoderWires::connected(std::size_t side) const {
  for (const Wire& wire : kWires[side]) {
    const bool input = (gpr_.value(iomuxc_gpr::GPR6.value) >> (wire.input + 12) & 1) == 0;
    if (iomuxc_.function(wire.mux) != 3 || iomuxc_.selection(wire.select) != wire.choice || !input ||
        xbara_.input_of(wire.output) != wire.input)
      return false;
  }
  return true;
}

void Enc::reset() {
  position_ = held_ = initial_ = 0;
  control_ = control2_ = filter_ = 0;
  compare_upper_ = compare_lower_ = 0xFFFF;
}

std::uint32_t Enc::filter_clocks() const {
  return enc::FILT_FILT_PER.of(filter_) * (enc::FILT_FILT_CNT.of(filter_) + 3);
}

void Enc::count(std::int32_t edges) {
  const bool reversed = enc::CTRL_REV.of(control_) != 0;
  position_ += static_cast<std::uint32_t>(reversed ? -edges : edges);
}

std::uint32_t Enc::read(std::uint32_t offset) {
  if (offset == enc::POSD.value || offset == enc::REV.value)
    machine_.fail({fmt::format("ENC{} {}: not modelled", number_, offset == enc::REV.value ? "REV" : "POSD"),
                   DecoderProblem::read_not_modelled,
                   {std::to_string(number_), offset == enc::REV.value ? "REV" : "POSD"}});
  if (offset == enc::UPOS.value || offset == enc::LPOS.value) held_ = position_;
  if (offset == enc::UPOS.value) return position_ >> 16;
  if (offset == enc::LPOS.value) return position_ & 0xFFFF;
  if (offset == enc::UPOSH.value) return held_ >> 16;
  if (offset == enc::LPOSH.value) return held_ & 0xFFFF;
  if (offset == enc::CTRL.value) return control_;
  if (offset == enc::CTRL2.value) return control2_;
  if (offset == enc::FILT.value) return filter_;
  if (offset == enc::UINIT.value) return initial_ >> 16;
  if (offset == enc::LINIT.value) return initial_ & 0xFFFF;
  if (offset == enc::UCOMP.value) return compare_upper_;
  if (offset == enc::LCOMP.value) return compare_lower_;
  return 0;
}

void Enc::write(std::uint32_t offset, std::uint32_t value) {
  const auto half = static_cast<std::uint16_t>(value);
  if (offset == enc::CTRL.value) {
    control_ = static_cast<std::uint16_t>(value & ~(kFlags | enc::CTRL_SWIP.mask()));
    if (enc::CTRL_SWIP.of(value) != 0) position_ = initial_;
  } else if (offset == enc::CTRL2.value) {
    if (enc::CTRL2_MOD.of(value) != 0)
      machine_.fail({fmt::format("ENC{} CTRL2: counting modulo is not modelled", number_),
                     DecoderProblem::modulo_not_modelled,
                     {std::to_string(number_)}});
    control2_ = half;
  } else if (offset == enc::FILT.value) {
    const bool runs = enc::FILT_FILT_PER.of(filter_) != 0;
    if (runs && enc::FILT_FILT_PER.of(value) != 0 && half != filter_)
      machine_.fail({fmt::format("ENC{} FILT: changed while its period is not 0", number_),
                     DecoderProblem::filter_running,
                     {std::to_string(number_)}});
    filter_ = half;
  } else if (offset == enc::UINIT.value) {
    initial_ = (initial_ & 0xFFFF) | value << 16;
  } else if (offset == enc::LINIT.value) {
    initial_ = (initial_ & 0xFFFF'0000) | (value & 0xFFFF);
  } else if (offset == enc::UPOS.value) {
    position_ = (position_ & 0xFFFF) | value << 16;
  } else if (offset == enc::LPOS.value) {
    position_ = (position_ & 0xFFFF'0000) | (value & 0xFFFF);
  } else if (offset == enc::UCOMP.value) {
    compare_upper_ = half;
  } else if (offset == enc::LCOMP.value) {
    compare_lower_ = half;
  } else if (offset != enc::UMOD.value && offset != enc::LMOD.value && offset != enc::IMR.value) {
    machine_.fail({fmt::format("ENC{}: a write to offset 0x{:02X} is not modelled", number_, offset),
                   DecoderProblem::write_not_modelled,
                   {std::to_string(number_), fmt::format("0x{:02X}", offset)}});
  }
}

}  // namespace astro::emulator
