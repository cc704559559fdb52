#pragma once

#include "common/protocol/enums.hpp"
#include "hal/interface/board.hpp"

namespace astro {

/// The board's reset cause as the protocol has it: the same values under the same names.
constexpr protocol::ResetCause on_the_wire(hal::ResetCause cause) {
  using Board = hal::ResetCause;
  using Wire = protocol::ResetCause;
  const auto same = [](Board a, Wire b) { return static_cast<int>(a) == static_cast<int>(b); };
  static_assert(same(Board::power_on, Wire::power_on) && same(Board::software, Wire::software) &&
                same(Board::watchdog, Wire::watchdog) && same(Board::fault, Wire::fault) &&
                same(Board::pin, Wire::pin) && same(Board::unknown, Wire::unknown));
  return static_cast<Wire>(cause);
}

}  // namespace astro
