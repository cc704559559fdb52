#pragma once

namespace astro::teensy40::core_clock {

/// 600 MHz core, 150 MHz bus, and 24 MHz from the crystal for timers and serial port. Raises the core's
/// supply to 1.25 V first. The flash's clock is left as the ROM has set it. From then on `wfi` stops the core
/// and nothing else: watchdog and memories go on.
void start();

}  // namespace astro::teensy40::core_clock
