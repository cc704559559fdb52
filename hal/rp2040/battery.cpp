#include "hal/rp2040/battery.hpp"

#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/pins.hpp"

namespace astro::rp2040 {
namespace {

constexpr std::uint32_t kOn = adc::CS_EN(1) | adc::CS_AINSEL(gp::kBattery - 26);

bool is_ready() { return ADC[adc::CS].get(adc::CS_READY) != 0; }
void begin_conversion() { ADC[adc::CS].write(kOn | adc::CS_START_ONCE(1)); }
std::uint32_t sample() { return ADC[adc::RESULT].get(adc::RESULT_RESULT); }

/// A read of the peripheral takes four cycles and more, so that this is a millisecond at the least.
bool wait_ready() {
  for (int reads = 0; reads < 30'000; ++reads)
    if (is_ready()) return true;
  return false;
}

}  // namespace

void Battery::start() {
  wake(resets::RESET_ADC.mask());
  apply(kBatteryPins);
  ADC[adc::CS].write(kOn);
  if (!wait_ready()) return;
  begin_conversion();
  if (!wait_ready()) return;
  voltage_.prime(sample());
  begin_conversion();
}

std::int32_t Battery::millivolts() noexcept {
  if (is_ready()) {
    voltage_.add(sample());
    begin_conversion();
  }
  return voltage_.millivolts();
}

}  // namespace astro::rp2040
