#include "hal/teensy40/tick.hpp"

#include "hal/teensy40/pins.hpp"
#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40 {
namespace {

constexpr std::uint32_t kPeriod_counts = 24'000;  // of the 24 MHz crystal
constexpr std::uint32_t kLedTicks = 512;

void (*on_tick)() = nullptr;
std::uint32_t ticks = 0;

void pit_interrupt() {
  PIT[pit::CHANNEL2_TFLG].write(pit::CHANNEL2_TFLG_TIF(1));
  on_tick();
  if (++ticks % kLedTicks == 0) GPIO7[gpio::DR_TOGGLE].write(gpio7::kLed);
  // The write must arrive before the interrupt returns, or the interrupt would run again.
  static_cast<void>(PIT[pit::CHANNEL2_TFLG].read());
}

}  // namespace

void Tick::start(void (*handler)()) {
  stop();
  on_tick = handler;
  PIT[pit::CHANNEL2_LDVAL].write(kPeriod_counts - 1);
  PIT[pit::CHANNEL2_TFLG].write(pit::CHANNEL2_TFLG_TIF(1));
  install(irq::kPit, urgency::kTick, pit_interrupt);
  PIT[pit::CHANNEL2_TCTRL].write(pit::CHANNEL2_TCTRL_TIE(1) | pit::CHANNEL2_TCTRL_TEN(1));
}

void Tick::stop() { PIT[pit::CHANNEL2_TCTRL].write(0); }

}  // namespace astro::teensy40
