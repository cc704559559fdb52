#include "hal/rp2040/watchdog.hpp"

#include "hal/rp2040/arithmetic/reset_cause.hpp"
#include "hal/rp2040/core/cpu.hpp"

namespace astro::rp2040::watchdog_timer {
namespace {

// It counts down twice each microsecond (erratum RP2040-E1).
constexpr std::uint32_t kLoad = kTimeOut_ms * 1000 * 2;
static_assert(kLoad < 1U << 24);

/// Everything but the oscillators starts anew with it.
void select_what_it_resets() {
  constexpr std::uint32_t kAllButOscillators = 0x0001'FFFC;
  PSM[psm::WDSEL].write(kAllButOscillators);
}

}  // namespace

void start() {
  select_what_it_resets();
  WATCHDOG[watchdog::SCRATCH0].write(marker::kRunning);
  feed();
  WATCHDOG[watchdog::CTRL].write(
      watchdog::CTRL_ENABLE(1));  // goes on while a debugger halts the core: no motor may
}

void stop() { WATCHDOG[watchdog::CTRL].clear(watchdog::CTRL_ENABLE.mask()); }

void feed() { WATCHDOG[watchdog::LOAD].write(kLoad); }

void restart(std::uint32_t left_marker) {
  const cpu::InterruptsOff guard;
  select_what_it_resets();
  WATCHDOG[watchdog::SCRATCH0].write(left_marker);
  WATCHDOG[watchdog::SCRATCH4].write(0);  // no entry point for the boot ROM
  cpu::synchronize();
  WATCHDOG[watchdog::CTRL].set(watchdog::CTRL_TRIGGER.mask());
  while (true) {
  }
}

}  // namespace astro::rp2040::watchdog_timer
