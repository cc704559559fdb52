#include "host/emulator/chip/flexpwm.hpp"

#include <algorithm>

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kSubmodule = 1U << 2;
constexpr Cycles kCyclesPerCount = 4;  // of the 150 MHz bus

}  // namespace

FlexPwm::FlexPwm(Machine& machine, const Iomuxc& iomuxc)
    : Stored({{pwm::SM2_CTRL.value, 0x0400},
              {pwm::SM2_DISMAP0.value, 0xFFFF},
              {pwm::SM2_DTCNT0.value, 0x07FF},
              {pwm::SM2_DTCNT1.value, 0x07FF}}),
      machine_(machine),
      iomuxc_(iomuxc) {}

void FlexPwm::reset() {
  Stored::reset();
  active_ = {};
  mask_ = 0;
  period_began_ = 0;
}

bool FlexPwm::running() const { return (pwm::MCTRL_RUN.of(value(pwm::MCTRL.value)) & kSubmodule) != 0; }
bool FlexPwm::locked() const { return (pwm::MCTRL_LDOK.of(value(pwm::MCTRL.value)) & kSubmodule) != 0; }

FlexPwm::Values FlexPwm::buffered() const {
  const auto half = [this](std::uint32_t offset) { return static_cast<std::uint16_t>(value(offset)); };
  return {half(pwm::SM2_INIT.value),
          half(pwm::SM2_VAL1.value),
          {half(pwm::SM2_VAL2.value), half(pwm::SM2_VAL4.value)},
          {half(pwm::SM2_VAL3.value), half(pwm::SM2_VAL5.value)}};
}

std::uint32_t FlexPwm::period_counts() const {
  return static_cast<std::uint16_t>(active_.val1 - active_.initial) + 1U;
}

void FlexPwm::load() {
  if (locked()) active_ = buffered();
  store(pwm::MCTRL.value, value(pwm::MCTRL.value) & ~pwm::MCTRL_LDOK(kSubmodule));
  mask_ = value(pwm::MASK.value);
}

/// A period ends.
void FlexPwm::event() {
  if (!running()) return;
  load();
  period_began_ = machine_.now();
  machine_.wake(*this, kNever);
}

std::uint32_t FlexPwm::read(std::uint32_t offset) {
  if (offset == pwm::MCTRL.value) return value(offset) & ~pwm::MCTRL_CLDOK.mask();
  return value(offset);
}

void FlexPwm::write_mctrl(std::uint32_t word) {
  const bool ran = running();
  std::uint32_t next = word & ~(pwm::MCTRL_CLDOK.mask() | pwm::MCTRL_LDOK.mask());
  // LDOK is set by writing 1 and cleared by CLDOK or the reload.
  std::uint32_t ldok = pwm::MCTRL_LDOK.of(value(pwm::MCTRL.value)) & ~pwm::MCTRL_CLDOK.of(word);
  ldok |= pwm::MCTRL_LDOK.of(word);
  store(pwm::MCTRL.value, next | pwm::MCTRL_LDOK(ldok));
  if (!ran && running()) {
    load();
    period_began_ = machine_.now();
  }
  if (running() && locked()) {
    const Cycles period = period_counts() * kCyclesPerCount;
    machine_.wake(*this, machine_.now() + period - (machine_.now() - period_began_) % period);
  }
}

void FlexPwm::write(std::uint32_t offset, std::uint32_t word) {
  const bool buffered_register = offset >= pwm::SM2_INIT.value && offset <= pwm::SM2_VAL5.value &&
                                 offset != pwm::SM2_CTRL2.value && offset != pwm::SM2_CTRL.value;
  if (buffered_register && locked())
    return machine_.fail("PWM2 SM2: values are written while the last ones wait to be loaded (MCTRL.LDOK)");
  if (offset == pwm::MCTRL.value) return write_mctrl(word);
  if (offset == pwm::FSTS0.value) return store(offset, value(offset) & ~(word & pwm::FSTS0_FFLAG.mask()));
  if (offset == pwm::SM2_CTRL.value && pwm::SM2_CTRL_PRSC.of(word) != 0)
    return machine_.fail("PWM2 SM2_CTRL: a prescaler is not modelled");
  store(offset, word);
  if (offset != pwm::MASK.value) return;
  const std::uint32_t at_once = pwm::MASK_UPDATE_MASK.of(word) & kSubmodule;
  if (at_once != 0 || !running()) {
    mask_ = word;
  } else {
    const Cycles period = period_counts() * kCyclesPerCount;
    machine_.wake(*this, machine_.now() + period - (machine_.now() - period_began_) % period);
  }
}

double FlexPwm::duty(std::size_t output) const {
  const std::uint32_t mux =
      output == 0 ? iomuxc::SW_MUX_CTL_PAD_GPIO_B0_10.value : iomuxc::SW_MUX_CTL_PAD_GPIO_B0_11.value;
  const Bits enable = output == 0 ? pwm::OUTEN_PWMA_EN : pwm::OUTEN_PWMB_EN;
  const Bits masked = output == 0 ? pwm::MASK_MASKA : pwm::MASK_MASKB;
  const Bits disable = output == 0 ? pwm::SM2_DISMAP0_DIS0A : pwm::SM2_DISMAP0_DIS0B;
  // Every fault input is low: one that is active low and mapped to the output keeps it off.
  const std::uint32_t faults = ~pwm::FCTRL0_FLVL.of(value(pwm::FCTRL0.value)) & 15;
  if (iomuxc_.function(mux) != 2 || !running() || (enable.of(value(pwm::OUTEN.value)) & kSubmodule) == 0 ||
      (masked.of(mask_) & kSubmodule) != 0 || (disable.of(value(pwm::SM2_DISMAP0.value)) & faults) != 0)
    return 0;
  const std::uint32_t period = period_counts();
  const std::uint32_t high = static_cast<std::uint16_t>(active_.fall[output] - active_.rise[output]);
  return std::min(1.0, static_cast<double>(high) / static_cast<double>(period));
}

}  // namespace astro::emulator
