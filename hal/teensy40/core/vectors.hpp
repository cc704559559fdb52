#pragma once

namespace astro::teensy40::vectors {

/// The table of exception handlers in RAM. Every entry is the fault handler until a driver installs its own
/// (core/interrupts.hpp). A fault or an unexpected interrupt opens both bridges, writes the reason to SRC_GPR5..8
/// and restarts the chip:
///
///   GPR5  marker::kFault     GPR6  exception number     GPR7  where it happened, 0 if the stack is gone
///   GPR8  SCB_CFSR
void start();

}  // namespace astro::teensy40::vectors
