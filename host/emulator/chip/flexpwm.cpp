#include "host/emulator/chip/flexpwm.hpp"

#include <algorithm>

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kSubmodule = 1U << 2;
constexpr std::uint32_t kFaultInputs = 15, kForceAtReload = 2;
constexpr std::uint32_t kAutomatic = 15U << 8;             // FAUTO of FCTRL0
constexpr std::uint32_t kOtherClocks = 3U << 8 | 3U << 0;  // INIT_SEL and CLK_SEL of CTRL2
constexpr Cycles kCyclesPerCount = 4;                      // of the 150 MHz bus

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
  faults_ = kFaultInputs;
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
  if (pwm::SM2_CTRL2_FORCE_SEL.of(value(pwm::SM2_CTRL2.value)) == kForceAtReload)
    mask_ = value(pwm::MASK.value);
}

void FlexPwm::load_when_period_ends() {
  const Cycles period = period_counts() * kCyclesPerCount;
  machine_.wake(*this, machine_.now() + period - (machine_.now() - period_began_) % period);
}

/// The crossbar leaves every fault input low, which is a fault unless FLVL makes high the fault level.
std::uint32_t FlexPwm::faults_now() const {
  return ~pwm::FCTRL0_FLVL.of(value(pwm::FCTRL0.value)) & kFaultInputs;
}

/// Called when a period ends.
void FlexPwm::event() {
  if (!running()) return;
  load();
  period_began_ = machine_.now();
  machine_.wake(*this, kNever);
}

std::uint32_t FlexPwm::read(std::uint32_t offset) {
  if (offset == pwm::MCTRL.value) return value(offset) & ~pwm::MCTRL_CLDOK.mask();
  if (offset == pwm::FSTS0.value) return faults_ | faults_now() << 8;  // FFPIN
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
  if (running() && locked()) load_when_period_ends();
}

void FlexPwm::write_mask(std::uint32_t word) {
  store(pwm::MASK.value, word & ~pwm::MASK_UPDATE_MASK.mask());
  const bool at_once = (pwm::MASK_UPDATE_MASK.of(word) & kSubmodule) != 0;
  if (at_once || !running())
    mask_ = word;
  else
    load_when_period_ends();
}

void FlexPwm::refuse_unmodelled() {
  const auto word = [this](auto reg) { return value(reg.value); };
  const std::uint32_t outputs = pwm::OUTEN_PWMA_EN(kSubmodule) | pwm::OUTEN_PWMB_EN(kSubmodule);
  if (pwm::SM2_CTRL_PRSC.of(word(pwm::SM2_CTRL)) != 0)
    machine_.fail({"PWM2 SM2_CTRL: a prescaler is not modelled", PwmProblem::prescaler_not_modelled});
  if (pwm::SM2_CTRL_FULL.of(word(pwm::SM2_CTRL)) == 0)
    machine_.fail(
        {"PWM2 SM2_CTRL: without FULL nothing is loaded when a period ends", PwmProblem::never_loaded});
  if ((word(pwm::SM2_CTRL2) & kOtherClocks) != 0)
    machine_.fail({"PWM2 SM2_CTRL2: only the bus clock and a start of its own are modelled",
                   PwmProblem::clock_not_modelled});
  if ((word(pwm::OUTEN) & outputs) != 0 && pwm::SM2_CTRL2_INDEP.of(word(pwm::SM2_CTRL2)) == 0)
    machine_.fail({"PWM2 OUTEN: complementary outputs are not modelled (SM2_CTRL2.INDEP)",
                   PwmProblem::complementary_not_modelled});
  if ((word(pwm::FCTRL0) & kAutomatic) != 0)
    machine_.fail({"PWM2 FCTRL0: only faults that the firmware clears are modelled",
                   PwmProblem::fault_mode_not_modelled});
  if (word(pwm::SM2_OCTRL) != 0)
    machine_.fail({"PWM2 SM2_OCTRL: only 0 is modelled", PwmProblem::output_control_not_modelled});
  if (word(pwm::SM2_FRCTRL) != 0)
    machine_.fail({"PWM2 SM2_FRCTRL: only 0 is modelled", PwmProblem::fractions_not_modelled});
}

void FlexPwm::write(std::uint32_t offset, std::uint32_t word) {
  const bool buffered_register = offset >= pwm::SM2_INIT.value && offset <= pwm::SM2_VAL5.value &&
                                 offset != pwm::SM2_CTRL2.value && offset != pwm::SM2_CTRL.value;
  if (buffered_register && locked())
    return machine_.fail({"PWM2 SM2: values are written while the last ones wait to be loaded (MCTRL.LDOK)",
                          PwmProblem::values_wait});
  if (offset == pwm::MCTRL.value) return write_mctrl(word);
  if (offset == pwm::MASK.value) return write_mask(word);
  if (offset == pwm::FSTS0.value) faults_ &= ~pwm::FSTS0_FFLAG.of(word);
  store(offset, word);
  faults_ |= faults_now();
  refuse_unmodelled();
}

double FlexPwm::duty(std::size_t output) const {
  const std::uint32_t mux =
      output == 0 ? iomuxc::SW_MUX_CTL_PAD_GPIO_B0_10.value : iomuxc::SW_MUX_CTL_PAD_GPIO_B0_11.value;
  const Bits enable = output == 0 ? pwm::OUTEN_PWMA_EN : pwm::OUTEN_PWMB_EN;
  const Bits masked = output == 0 ? pwm::MASK_MASKA : pwm::MASK_MASKB;
  const Bits disable = output == 0 ? pwm::SM2_DISMAP0_DIS0A : pwm::SM2_DISMAP0_DIS0B;
  if (iomuxc_.function(mux) != 2 || !running() || (enable.of(value(pwm::OUTEN.value)) & kSubmodule) == 0 ||
      (masked.of(mask_) & kSubmodule) != 0 || (disable.of(value(pwm::SM2_DISMAP0.value)) & faults_) != 0)
    return 0;
  const std::uint32_t period = period_counts();
  const std::uint32_t high = static_cast<std::uint16_t>(active_.fall[output] - active_.rise[output]);
  return std::min(1.0, static_cast<double>(high) / static_cast<double>(period));
}

}  // namespace astro::emulator
