#include "hal/rp2040/motors.hpp"

#include "hal/rp2040/arithmetic/duty_counts.hpp"
#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/pins.hpp"

namespace astro::rp2040 {
namespace {

constexpr std::uint32_t kStride = 0x14;  // from slice to slice
constexpr std::uint32_t kForcedLow = 2;  // OUTOVER

void set_counts(std::uint32_t unit, BridgeCounts counts) {
  PWM.at(pwm::CH0_CC, unit, kStride).write(pwm::CH0_CC_A(counts.in1) | pwm::CH0_CC_B(counts.in2));
}

/// The counts that were just set take effect at the next clock instead of the next period.
void begin_period(std::uint32_t unit) { PWM.at(pwm::CH0_CTR, unit, kStride).write(kPwmPeriod_counts - 1); }

bool are_open() { return control_of(gp::kLeftIn1).get(io::GPIO0_CTRL_OUTOVER) == kForcedLow; }

/// From the open bridges: the PWM still runs with the counts of the last drive, so the new ones are put in force first.
void close() {
  begin_period(slice::kLeft);
  begin_period(slice::kRight);
  for (const Pin& pin : kBridgePins) control_of(pin.number).clear(io::GPIO0_CTRL_OUTOVER.mask());
  SIO[sio::GPIO_OUT_SET].write(1U << gp::kEnable);
}

void set_both(BridgeCounts left, BridgeCounts right) {
  const bool open = are_open();
  set_counts(slice::kLeft, left);
  set_counts(slice::kRight, right);
  if (open) close();
}

void start_slice(std::uint32_t unit) {
  PWM.at(pwm::CH0_CSR, unit, kStride).write(0);
  PWM.at(pwm::CH0_DIV, unit, kStride).write(pwm::CH0_DIV_INT(1));
  PWM.at(pwm::CH0_TOP, unit, kStride).write(kPwmPeriod_counts - 1);
  PWM.at(pwm::CH0_CTR, unit, kStride).write(0);
  set_counts(unit, kOpen);
  PWM.at(pwm::CH0_CSR, unit, kStride).write(pwm::CH0_CSR_EN(1));
}

}  // namespace

void Motors::start() {
  wake(resets::RESET_IO_BANK0.mask() | resets::RESET_PADS_BANK0.mask() | resets::RESET_PWM.mask());
  constexpr std::uint32_t kOutputs = 1U << gp::kEnable | 1U << gp::kLed;
  SIO[sio::GPIO_OUT_CLR].write(kOutputs);
  SIO[sio::GPIO_OE_SET].write(kOutputs);
  SIO[sio::GPIO_OE_CLR].write(1U << gp::kDriverError);
  apply(kLogicPins);
  start_slice(slice::kLeft);
  start_slice(slice::kRight);
  coast();
  apply(kBridgePins);  // counts of zero keep them low ...
  coast();             // ... until they are forced low again
}

void Motors::drive(hal::Duty duty) noexcept { set_both(bridge_counts(duty.left), bridge_counts(duty.right)); }

void Motors::brake() noexcept { set_both(kBrake, kBrake); }

void Motors::coast() noexcept {
  // A tick that drove between these stores would find the bridges open and close them.
  const cpu::InterruptsOff guard;
  SIO[sio::GPIO_OUT_CLR].write(1U << gp::kEnable);
  for (const Pin& pin : kBridgePins) control_of(pin.number).set(io::GPIO0_CTRL_OUTOVER(kForcedLow));
}

bool Motors::fault() noexcept {
  constexpr int kReads = 50;  // of five cycles at the very least: two microseconds
  for (int i = 0; i < kReads; ++i)
    if ((SIO[sio::GPIO_IN].read() & 1U << gp::kDriverError) != 0) return false;
  return true;
}

}  // namespace astro::rp2040
