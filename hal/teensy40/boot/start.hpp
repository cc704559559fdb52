#pragma once

namespace astro::teensy40 {

/// Where the boot ROM jumps to: memories, outputs low, the program copied from the flash into RAM; then
/// watchdogs off, vectors, protection, caches, 600 MHz, constructors and main(). Nothing runs from the flash
/// after that.
extern "C" [[noreturn]] void reset();

}  // namespace astro::teensy40
