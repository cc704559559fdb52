#pragma once

namespace astro::rp2040 {

/// The second stage of the boot jumps here. Sets the clocks, copies the program from the flash into SRAM, then sets up the
/// vectors and calls constructors and main(). After that nothing runs from the flash.
extern "C" [[noreturn]] void reset();

}  // namespace astro::rp2040
