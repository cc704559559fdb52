#pragma once

#include <cstdint>

#include "hal/rp2040/registers/registers.hpp"

namespace astro::rp2040 {

/// Microseconds since the start from the TIMER, which counts the crystal. It starts at 0 after every reset.
///
/// Errors  the crystal's, some 30 ppm
/// Cost    three reads of the peripheral. Both words are read as they are, without the latch, which only one context could
///         use.
class Clock {
 public:
  std::uint64_t now_us() const noexcept {
    std::uint32_t upper = TIMER[timer::TIMERAWH].read();
    while (true) {
      const std::uint32_t lower = TIMER[timer::TIMERAWL].read();
      const std::uint32_t now = TIMER[timer::TIMERAWH].read();
      if (now == upper) return std::uint64_t{upper} << 32 | lower;
      upper = now;
    }
  }
};

}  // namespace astro::rp2040
