#pragma once

#include <cstdint>

#include "hal/interface/board.hpp"

namespace astro {

/// What the board shows at the start of a tick.
struct TickInput {
  std::uint64_t now_us = 0;
  hal::EncoderCounts counts;
  std::int32_t battery_mv = 0;
  bool driver_fault = false;
};

}  // namespace astro
