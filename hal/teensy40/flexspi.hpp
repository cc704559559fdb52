#pragma once

#include <cstdint>
#include <span>

#include "hal/teensy40/arithmetic/lut.hpp"

/// Commands to the program flash, past the mapping that reads it. Sequence 15 of the controller's table is
/// ours; sequence 0, which maps the flash, stays as the ROM left it.
///
/// While the flash is busy nothing may fetch from it: all code and data that can run live in the tightly
/// coupled memories, the interrupts' as well. So interrupts go on during the long wait for an erase, and are
/// held off only while a command is on the wires, for some ten microseconds.
namespace astro::teensy40::flexspi_commands {

/// Opens the table; waits until the mapping has finished its prefetches.
bool begin();

/// Closes the table, and drops what the controller and the data cache still believe of `bytes` at `offset`.
void end(std::uint32_t offset, std::uint32_t bytes);

/// One command, `offset` from the start of the flash. False if the controller reports an error.
bool run(FlashCommand command, std::uint32_t offset);

/// A command with data: at most a page, in pairs of words.
bool write(FlashCommand command, std::uint32_t offset, std::span<const std::uint8_t> bytes);

/// A command that answers with one byte; 0xFF, which means busy, if it fails.
std::uint32_t read_byte(FlashCommand command);

}  // namespace astro::teensy40::flexspi_commands
