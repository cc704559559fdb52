#pragma once

#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40 {

/// Switches on the clock of a peripheral, in run and in wait mode. An access to a peripheral without its
/// clock hangs the bus. Start-up only, because it reads, changes and writes a shared register.
inline void open_gate(Register<std::uint32_t> ccgr, Bits gate) { ccgr.modify(0, gate(3)); }

}  // namespace astro::teensy40
