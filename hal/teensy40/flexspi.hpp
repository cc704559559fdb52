#pragma once

#include <cstdint>
#include <span>

#include "hal/teensy40/arithmetic/lut.hpp"

/// Commands to the program flash, which is otherwise read through its mapping. They use sequence 15 of the
/// controller's table; sequence 0, which maps the flash, stays as the ROM has set it.
///
/// Nothing may be fetched from the flash while it is busy. All code and data, including the interrupts', are
/// in the tightly coupled memories. So interrupts continue during the long wait for an erase; they are
/// disabled only while a command is on the wires, for some ten microseconds.
namespace astro::teensy40::flexspi_commands {

/// Opens the table; waits until the mapping has finished its prefetches.
bool begin();

/// Closes the table, and invalidates `bytes` at `offset` in the controller's buffers and the data cache.
void end(std::uint32_t offset, std::uint32_t bytes);

/// One command, `offset` from the start of the flash. False if the controller reports an error.
bool run(FlashCommand command, std::uint32_t offset);

/// A command with data: at most a page, in pairs of words.
bool write(FlashCommand command, std::uint32_t offset, std::span<const std::uint8_t> bytes);

/// A command that answers with one byte; 0xFF, which means busy, if it fails.
std::uint32_t read_byte(FlashCommand command);

}  // namespace astro::teensy40::flexspi_commands
