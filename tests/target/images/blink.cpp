#include "hal/teensy40/core/interrupts.hpp"
#include "hal/teensy40/pins.hpp"
#include "hal/teensy40/registers/registers.hpp"

/// The smallest image: boot, one interrupt, one pin. The LED changes every millisecond; on a Teensy that
/// starts with nothing else it shows that boot is right, and in the emulator that the models of these few
/// parts are.
namespace {

using namespace astro::teensy40;

void pit_interrupt() {
  PIT[pit::CHANNEL2_TFLG].write(pit::CHANNEL2_TFLG_TIF(1));
  GPIO7[gpio::DR_TOGGLE].write(gpio7::kLed);
  static_cast<void>(
      PIT[pit::CHANNEL2_TFLG].read());  // the write above has arrived, or the interrupt comes again
}

}  // namespace

int main() {
  GPIO7[gpio::GDIR].modify(0, gpio7::kLed);
  PIT[pit::CHANNEL2_LDVAL].write(24'000 - 1);  // of the 24 MHz crystal
  install(irq::kPit, urgency::kTick, pit_interrupt);
  PIT[pit::CHANNEL2_TCTRL].write(pit::CHANNEL2_TCTRL_TIE(1) | pit::CHANNEL2_TCTRL_TEN(1));
  while (true) asm volatile("wfi" ::: "memory");
}
