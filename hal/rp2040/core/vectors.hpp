#pragma once

namespace astro::rp2040::vectors {

/// The table of exception handlers in SRAM. Every entry is the fault handler until a driver installs its own
/// (core/interrupts.hpp). A fault or an unexpected interrupt opens both bridges, writes the reason to the watchdog's
/// scratch registers and restarts the chip:
///
///   SCRATCH0  marker::kFault     SCRATCH1  exception number     SCRATCH2  where it happened, 0 if the stack is gone
void start();

}  // namespace astro::rp2040::vectors
