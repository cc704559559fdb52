#pragma once

#include <cstdint>

#include "hal/teensy40/core/interrupts.hpp"

namespace astro::teensy40 {

/// The control tick: 1 kHz from PIT channel 2, the most urgent interrupt. The LED changes every 512 ticks, so
/// it blinks about once a second while the tick runs.
class Tick {
 public:
  /// Calls `handler` every millisecond from the interrupt. Needs Clock::start().
  static void start(void (*handler)());
  static void stop();
};

/// While such an object lives neither the tick nor any less urgent interrupt runs. The objects nest.
///
/// Why     BASEPRI instead of the NVIC's registers: only the level before has to be remembered, and faults
///         still run
/// Cost    four instructions
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
