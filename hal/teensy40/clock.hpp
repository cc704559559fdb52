#pragma once

#include <cstdint>

#include "hal/teensy40/arithmetic/microseconds.hpp"
#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40 {

/// Microseconds since start() from the PIT's lifetime timer: channels 0 and 1 as one 64-bit counter of the 24
/// MHz crystal. It starts at 0 after every reset, including a warm one.
///
/// Errors  the crystal's, some 30 ppm
/// Cost    now_us(): three reads of the peripheral and about 20 instructions; one call in 100 million takes
///         42 ns longer
class Clock {
 public:
  /// Boot calls it early; needs the PIT on the 24 MHz crystal. Stops all channels, which the ROM leaves
  /// running.
  static void start();

  std::uint64_t now_us() const noexcept {
    // Reading the upper word latches the lower one. An interrupt that reads in between latches another value:
    // that shows in a changed upper word, or is harmless. When the lower word wraps, the upper word may
    // follow one count later, and the time would go back by 179 s; then both are read again.
    constexpr std::uint32_t kBegunAnew = ~0U;
    std::uint32_t upper = PIT[pit::LTMR64H].read(), lower = 0;
    for (bool moved = true; moved;) {
      lower = PIT[pit::LTMR64L].read();
      const std::uint32_t now = PIT[pit::LTMR64H].read();
      moved = now != upper || lower == kBegunAnew;
      upper = now;
    }
    return microseconds(~(std::uint64_t{upper} << 32 | lower));  // it counts down from all ones
  }
};

}  // namespace astro::teensy40
