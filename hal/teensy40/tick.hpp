#pragma once

#include <cstdint>

#include "hal/teensy40/interrupts.hpp"

namespace astro::teensy40 {

/// The control tick: 1 kHz from PIT channel 2, the most urgent interrupt. The LED changes every 512 ticks, so
/// a Teensy that blinks once a second is one whose tick runs.
class Tick {
 public:
  /// Calls `handler` every millisecond from the interrupt. Needs Clock::start().
  static void start(void (*handler)());
  static void stop();
};

/// While one lives the tick does not run, nor does anything less urgent. They nest.
///
/// Why     one register instead of the NVIC's: nothing to remember but the level before, and faults get
/// through. Cost    four instructions.
class [[nodiscard]] TickHold {
 public:
  TickHold() {
    asm volatile("mrs %0, basepri\n msr basepri_max, %1\n isb" : "=&r"(before_) : "r"(kMask) : "memory");
  }
  ~TickHold() { asm volatile("msr basepri, %0" ::"r"(before_) : "memory"); }
  TickHold(const TickHold&) = delete;
  TickHold& operator=(const TickHold&) = delete;

 private:
  static constexpr std::uint32_t kMask = priority_byte(urgency::kTick);
  std::uint32_t before_;
};

}  // namespace astro::teensy40
