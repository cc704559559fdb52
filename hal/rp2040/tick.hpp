#pragma once

#include <cstdint>

#include "hal/rp2040/core/cpu.hpp"

namespace astro::rp2040 {

/// The control tick: 1 kHz from an alarm of the TIMER, the most urgent interrupt. The LED changes every 512 ticks, so it
/// blinks about once a second while the tick runs.
///
/// The next alarm is a millisecond after the one before, not after the interrupt, so a late tick does not delay those that
/// follow. An alarm comes when the timer equals it: a moment that has passed would come again after 71 minutes. So moments
/// that were missed, which takes an interrupt held for a millisecond, are skipped.
class Tick {
 public:
  /// Calls `handler` every millisecond from the interrupt.
  static void start(void (*handler)());
};

/// While such an object lives no interrupt runs: this processor has no other way to hold only some of them that nests.
/// Faults still do.
using TickHold = cpu::InterruptsOff;

}  // namespace astro::rp2040
