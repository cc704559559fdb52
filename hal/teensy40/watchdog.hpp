#pragma once

#include <cstdint>

namespace astro::teensy40::watchdog {

/// Half a second without feeding restarts the chip: longer than the 400 ms that the flash may take to erase a
/// sector, so that a restart never finds the flash busy.
///
/// Why     WDOG3, the RTWDOG: one store feeds it. What the other two would do to the Teensy's companion chip
///         through their output pin is not known.
inline constexpr std::uint32_t kTimeOut_ms = 512;

/// Arms it. Boot has switched it off.
void start();

/// At boot, since it bites 32 ms after a reset unless the ROM has stopped it; and for the boot loader, which
/// does not feed.
void stop();

/// A single store: any context.
void feed();

}  // namespace astro::teensy40::watchdog
