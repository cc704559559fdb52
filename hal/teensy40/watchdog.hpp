#pragma once

#include <cstdint>

namespace astro::teensy40::watchdog {

/// Half a second without feeding restarts the chip. That is longer than the 400 ms that the flash may take to
/// erase a sector, so a restart never finds the flash busy.
///
/// Why     WDOG3, the RTWDOG, is fed by one store. It is not known what the other two do to the Teensy's
///         second chip through their output pin.
inline constexpr std::uint32_t kTimeOut_ms = 512;

/// Starts the watchdog, which boot has switched off.
void start();

/// Switches it off: at boot, because it restarts the chip 32 ms after a reset unless the ROM has stopped it;
/// and for the boot loader, which does not feed it.
void stop();

/// A single store; callable from any context.
void feed();

}  // namespace astro::teensy40::watchdog
