#pragma once

namespace astro::teensy40 {

/// The boot ROM jumps here. Sets up the memories, sets the outputs low and copies the program from the flash
/// into RAM; then switches the watchdogs off, sets up vectors, protection, caches and 600 MHz, and calls
/// constructors and main(). After that nothing runs from the flash.
extern "C" [[noreturn]] void reset();

}  // namespace astro::teensy40
