#include "hal/teensy40/battery.hpp"

#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/pins.hpp"

namespace astro::teensy40 {
namespace {

constexpr std::uint32_t kChannel = 7;
constexpr std::uint32_t kReads = 1'000'000;  // calibration takes 3 ms if the oscillator is slow

// Own oscillator halved, 12 bits, long sample times, 32 samples averaged by the converter: about 0.2 ms.
constexpr std::uint32_t kConfiguration = adc::CFG_ADICLK(3) | adc::CFG_MODE(2) | adc::CFG_ADLSMP(1) |
                                         adc::CFG_ADIV(1) | adc::CFG_ADSTS(3) | adc::CFG_ADHSC(1) |
                                         adc::CFG_AVGS(3);

bool calibrate() {
  ADC1[adc::GS].write(adc::GS_CALF(1));  // clears the flag of an earlier calibration
  ADC1[adc::GC].write(adc::GC_AVGE(1) | adc::GC_CAL(1));
  return poll(ADC1[adc::GC], adc::GC_CAL, 0, kReads) && ADC1[adc::GS].get(adc::GS_CALF) == 0;
}

void begin_conversion() { ADC1[adc::HC0].write(adc::HC0_ADCH(kChannel)); }
std::uint32_t sample() { return ADC1[adc::R0].get(adc::R0_CDATA); }

}  // namespace

void Battery::start() {
  open_gate(CCM[ccm::CCGR1], ccm::CCGR1_CG8);
  apply(kBatteryPins);
  ADC1[adc::CFG].write(kConfiguration);
  if (!calibrate()) return;
  begin_conversion();
  if (!poll(ADC1[adc::HS], adc::HS_COCO0, 1, kReads)) return;
  voltage_.prime(sample());
  begin_conversion();
}

std::int32_t Battery::millivolts() noexcept {
  if (ADC1[adc::HS].get(adc::HS_COCO0) != 0) {
    voltage_.add(sample());
    begin_conversion();
  }
  return voltage_.millivolts();
}

}  // namespace astro::teensy40
