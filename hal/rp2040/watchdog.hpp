#pragma once

#include <cstdint>

namespace astro::rp2040::watchdog_timer {

/// Half a second without feeding restarts the chip. That is longer than the 400 ms that the flash may take to erase a
/// sector.
inline constexpr std::uint32_t kTimeOut_ms = 512;

/// Starts the watchdog.
void start();

/// Stops it. A restart by the watchdog does not reset the watchdog itself, so it may still run when the chip starts.
void stop();

/// A single store; callable from any context.
void feed();

/// Restarts the chip now. `left_marker` says why to the next start (arithmetic/reset_cause.hpp).
[[noreturn]] void restart(std::uint32_t left_marker);

}  // namespace astro::rp2040::watchdog_timer
