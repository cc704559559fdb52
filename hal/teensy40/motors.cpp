#include "hal/teensy40/motors.hpp"

#include "hal/teensy40/arithmetic/duty_counts.hpp"
#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/pins.hpp"

namespace astro::teensy40 {
namespace {

constexpr std::uint32_t kSubmodule = 1U << 2;  // its bit in each field of the registers that all four share
constexpr std::uint32_t kLeftMask = pwm::MASK_MASKA(kSubmodule), kRightMask = pwm::MASK_MASKB(kSubmodule);
constexpr std::uint32_t kRunning = pwm::MCTRL_RUN(kSubmodule);

/// Holds the outputs of `mask` low from now on; the other one stays as it is.
void silence(std::uint32_t mask) {
  PWM2[pwm::MASK].modify(0, mask | pwm::MASK_UPDATE_MASK(kSubmodule));
  // Read back, because the direction pins are on a faster bus and might change before this write arrives.
  static_cast<void>(PWM2[pwm::MASK].read());
}

/// The direction pins of one motor: by the sign of the duty; for a duty of 0 as they are, or forward if they
/// coast.
std::uint32_t direction(std::int16_t duty, std::uint32_t now, std::uint32_t forward, std::uint32_t reverse) {
  if (duty > 0) return forward;
  if (duty < 0) return reverse;
  return (now & reverse) != 0 ? reverse : forward;
}

void set_directions(std::uint32_t pins) {
  GPIO7[gpio::DR_CLEAR].write(gpio7::kDirections & ~pins);
  GPIO7[gpio::DR_SET].write(pins);
}

/// Both counts take effect together when the running period ends.
void set_counts(std::uint32_t left, std::uint32_t right) {
  PWM2[pwm::MCTRL].write(kRunning | pwm::MCTRL_CLDOK(kSubmodule));  // unlocks what the last call left waiting
  PWM2[pwm::SM2_VAL3].write(left);
  PWM2[pwm::SM2_VAL5].write(right);
  PWM2[pwm::MCTRL].write(kRunning | pwm::MCTRL_LDOK(kSubmodule));
}

void outputs_low() {
  IOMUXC_GPR[iomuxc_gpr::GPR27].write(~0U);  // the pins of GPIO2 belong to its fast copy, GPIO7
  constexpr std::uint32_t kOutputs = gpio7::kDirections | gpio7::kLeftPwm | gpio7::kRightPwm | gpio7::kLed;
  GPIO7[gpio::DR_CLEAR].write(kOutputs);
  GPIO7[gpio::GDIR].modify(gpio7::kDriverError, kOutputs);
  apply(kLogicPins);
}

/// No fault input may switch the outputs: after reset all four are mapped, active and tied to their level.
void ignore_fault_inputs() {
  PWM2[pwm::FCTRL0].write(pwm::FCTRL0_FLVL(15));
  PWM2[pwm::FSTS0].write(pwm::FSTS0_FFLAG(15));
  PWM2[pwm::SM2_DISMAP0].write(0);
}

/// Two independent outputs without dead time, reloaded in every period. DBGEN stays off, so the outputs go
/// low when a debugger halts the core.
void configure_submodule() {
  constexpr std::uint32_t kForceAtReload = 2;  // so that MASK, too, changes when a period ends
  PWM2[pwm::SM2_CTRL2].write(pwm::SM2_CTRL2_INDEP(1) | pwm::SM2_CTRL2_WAITEN(1) |
                             pwm::SM2_CTRL2_FORCE_SEL(kForceAtReload));
  PWM2[pwm::SM2_CTRL].write(pwm::SM2_CTRL_FULL(1));
  PWM2[pwm::SM2_OCTRL].write(0);
  PWM2[pwm::SM2_FRCTRL].write(0);
  PWM2[pwm::SM2_DTCNT0].write(0);
  PWM2[pwm::SM2_DTCNT1].write(0);
}

/// Edge-aligned: high from VAL2 (4) to VAL3 (5), so that VAL3 = 0 is never high, and VAL3 beyond VAL1, where
/// the counter starts over, never low.
void set_period() {
  PWM2[pwm::SM2_INIT].write(0);
  PWM2[pwm::SM2_VAL0].write(0);
  PWM2[pwm::SM2_VAL1].write(kPwmPeriod_counts - 1);
  PWM2[pwm::SM2_VAL2].write(0);
  PWM2[pwm::SM2_VAL4].write(0);
  PWM2[pwm::SM2_VAL3].write(0);
  PWM2[pwm::SM2_VAL5].write(0);
}

void start_pwm() {
  open_gate(CCM[ccm::CCGR4], ccm::CCGR4_CG9);
  PWM2[pwm::OUTEN].write(0);
  ignore_fault_inputs();
  PWM2[pwm::MCTRL].write(pwm::MCTRL_CLDOK(kSubmodule));
  configure_submodule();
  set_period();
  PWM2[pwm::MCTRL].write(pwm::MCTRL_LDOK(kSubmodule));  // before it runs, or it would start with old values
  PWM2[pwm::MCTRL].write(pwm::MCTRL_LDOK(kSubmodule) | kRunning);
  PWM2[pwm::OUTEN].write(pwm::OUTEN_PWMA_EN(kSubmodule) | pwm::OUTEN_PWMB_EN(kSubmodule));
}

}  // namespace

void Motors::start() {
  outputs_low();
  start_pwm();
  coast();
  apply(kPwmPins);
}

void Motors::drive(hal::Duty duty) noexcept {
  using namespace gpio7;
  const std::uint32_t now = GPIO7[gpio::DR].read();
  const std::uint32_t left = direction(duty.left, now, kLeftForward, kLeftReverse);
  const std::uint32_t right = direction(duty.right, now, kRightForward, kRightReverse);
  std::uint32_t turning = 0;
  if ((now & (kLeftForward | kLeftReverse)) != left) turning |= kLeftMask;
  if ((now & (kRightForward | kRightReverse)) != right) turning |= kRightMask;
  if (turning != 0) {
    silence(turning);
    set_directions(left | right);
  }
  set_counts(duty_counts(duty.left), duty_counts(duty.right));
  PWM2[pwm::MASK].write(0);  // when the running period ends
}

void Motors::brake() noexcept {
  using namespace gpio7;
  silence(kLeftMask | kRightMask);
  const std::uint32_t now = GPIO7[gpio::DR].read();
  set_directions(direction(0, now, kLeftForward, kLeftReverse) |
                 direction(0, now, kRightForward, kRightReverse));
}

void Motors::coast() noexcept {
  GPIO7[gpio::DR_CLEAR].write(gpio7::kDirections);
  PWM2[pwm::MASK].write(kLeftMask | kRightMask | pwm::MASK_UPDATE_MASK(kSubmodule));
}

bool Motors::fault() noexcept {
  constexpr int kReads = 200;  // a read takes 5 ns at the very least
  for (int i = 0; i < kReads; ++i)
    if ((GPIO7[gpio::PSR].read() & gpio7::kDriverError) != 0) return false;
  return true;
}

}  // namespace astro::teensy40
