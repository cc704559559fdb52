#pragma once

namespace astro::teensy40::core_clock {

/// 600 MHz core, 150 MHz bus, and 24 MHz from the crystal for timers and serial port. Raises the core's
/// supply to 1.25 V first. The flash's clock stays as the ROM has set it. From then on `wfi` stops only the
/// core; watchdog and memories continue.
void start();

}  // namespace astro::teensy40::core_clock
