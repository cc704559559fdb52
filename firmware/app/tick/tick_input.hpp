#pragma once

#include <cstdint>

#include "hal/interface/board.hpp"

namespace astro {

/// What a tick reads from the board at its start.
struct TickInput {
  std::uint64_t now_us = 0;
  hal::EncoderCounts counts;
  std::int32_t battery_mv = 0;
  bool driver_fault = false;
  bool on_time = true;  // false: this tick, or the thousand before it, did not come at 1 kHz
};

}  // namespace astro
