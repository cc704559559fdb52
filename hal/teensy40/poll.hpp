#pragma once

#include <cstdint>

#include "hal/teensy40/registers/access.hpp"

namespace astro::teensy40 {

/// Reads until `field` is `value`. False if it is not after `reads` reads: nothing here waits for ever.
///
/// Cost    a read of a peripheral takes some 10 ns and more, so `reads` is a time too: at least that.
template <class W>
[[nodiscard]] inline bool poll(Register<W> reg, Bits field, std::uint32_t value, std::uint32_t reads) {
  for (; reads != 0; --reads)
    if (reg.get(field) == value) return true;
  return false;
}

}  // namespace astro::teensy40
