#pragma once

#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40 {

/// Lets the clock through to a peripheral, in run and in wait mode. Touching one without its clock hangs the
/// bus. Start-up only: it reads, changes and writes a register that many share.
inline void open_gate(Register<std::uint32_t> ccgr, Bits gate) { ccgr.modify(0, gate(3)); }

}  // namespace astro::teensy40
