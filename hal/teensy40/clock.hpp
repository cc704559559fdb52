#pragma once

#include <cstdint>

#include "hal/teensy40/arithmetic/microseconds.hpp"
#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40 {

/// Microseconds since start() from the PIT's lifetime timer: channels 0 and 1 as one 64-bit counter of the
/// 24 MHz crystal. It begins at 0 after every reset, a warm one too: the timer does not outlive it.
///
/// Errors  the crystal's, some 30 ppm.
/// Cost    now_us() three reads of the peripheral and about 20 instructions; in one call of 100 million, for
/// 42 ns more.
class Clock {
 public:
  /// Boot calls it early; needs the PIT on the 24 MHz crystal. Stops all channels, which the ROM leaves
  /// running.
  static void start();

  std::uint64_t now_us() const noexcept {
    // Reading the upper word holds the lower one still. An interrupt that reads in between holds another one:
    // seen by the upper word having moved on, or else harmless. While the lower word begins anew, for one
    // count, the upper word may not have followed yet, and the time would go back by 179 s: then once more.
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
