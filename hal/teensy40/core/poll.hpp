#pragma once

#include <cstdint>

#include "hal/teensy40/registers/access.hpp"

namespace astro::teensy40 {

/// Reads until `field` is `value`; returns false after `reads` reads, so that nothing waits for ever.
///
/// Cost    a read of a peripheral takes 10 ns or more, so `reads` also is a lower bound of the time.
template <class W>
[[nodiscard]] inline bool poll(Register<W> reg, Bits field, std::uint32_t value, std::uint32_t reads) {
  for (; reads != 0; --reads)
    if (reg.get(field) == value) return true;
  return false;
}

}  // namespace astro::teensy40
