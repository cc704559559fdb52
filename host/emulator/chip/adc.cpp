#include "host/emulator/chip/adc.hpp"

#include <algorithm>
#include <cmath>

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kBatteryChannel = 7, kNoChannel = 31, kKeeper = 1U << 12, k12Bits = 2;
constexpr double kFullScale_V = 3.3;
constexpr Cycles kOneSample = 6 * kCyclesPerMicrosecond, kCalibration = 1000 * kCyclesPerMicrosecond;

}  // namespace

Adc::Adc(Machine& machine, const Iomuxc& iomuxc)
    : Stored({{adc::HC0.value, 0x1F}, {adc::CFG.value, 0x200}}), machine_(machine), iomuxc_(iomuxc) {}

void Adc::reset() {
  Stored::reset();
  calibrated_ = complete_ = busy_ = false;
  result_ = 0;
}

Cycles Adc::conversion() const {
  const std::uint32_t samples =
      adc::GC_AVGE.of(value(adc::GC.value)) != 0 ? 4U << adc::CFG_AVGS.of(value(adc::CFG.value)) : 1;
  return samples * kOneSample;
}

void Adc::stop() {
  if (busy_) machine_.wake(*this, kNever);
  busy_ = false;
}

void Adc::event() {
  if (adc::GC_CAL.of(value(adc::GC.value)) != 0) {
    store(adc::GC.value, value(adc::GC.value) & ~adc::GC_CAL.mask());
    calibrated_ = true;
    return;
  }
  busy_ = false;
  complete_ = true;
  const double ratio = std::clamp(pin_V() / kFullScale_V, 0.0, 1.0);
  result_ = static_cast<std::uint32_t>(std::lround(ratio * 4095));
}

std::uint32_t Adc::read(std::uint32_t offset) {
  if (offset == adc::HS.value) return complete_ ? adc::HS_COCO0(1) : 0;
  if (offset == adc::R0.value) {
    complete_ = false;
    return result_;
  }
  return value(offset);
}

void Adc::write(std::uint32_t offset, std::uint32_t word) {
  store(offset, word);
  if (offset == adc::GS.value) store(offset, 0);
  if (offset == adc::GC.value && adc::GC_CAL.of(word) != 0)
    machine_.wake(*this, machine_.now() + kCalibration);
  if (offset != adc::HC0.value) return;
  const std::uint32_t channel = adc::HC0_ADCH.of(word);
  if (channel == kNoChannel) return stop();
  if (channel != kBatteryChannel)
    return machine_.fail({"ADC1 HC0: nothing is connected to this channel", AdcProblem::not_connected});
  if (adc::CFG_MODE.of(value(adc::CFG.value)) != k12Bits)
    return machine_.fail({"ADC1 CFG: only 12 bits are modelled", AdcProblem::resolution_not_modelled});
  if (!calibrated_)
    return machine_.fail({"ADC1 HC0: a conversion before the calibration", AdcProblem::not_calibrated});
  if (busy_)
    return machine_.fail(
        {"ADC1 HC0: a conversion is begun while another one runs, which is lost", AdcProblem::busy});
  if ((iomuxc_.setting(iomuxc::SW_PAD_CTL_PAD_GPIO_AD_B1_02.value) & kKeeper) != 0)
    return machine_.fail(
        {"ADC1 HC0: the keeper of the pad falsifies what it reads (IOMUXC SW_PAD_CTL_PAD_GPIO_AD_B1_02)",
         AdcProblem::keeper_on});
  busy_ = true;
  complete_ = false;
  machine_.wake(*this, machine_.now() + conversion());
}

}  // namespace astro::emulator
