#pragma once

#include <cstdint>

#include "firmware/app/tick/check_in.hpp"
#include "firmware/app/tick/drive.hpp"
#include "firmware/app/tick/fault_watch.hpp"
#include "firmware/app/tick/tick_clock.hpp"

namespace astro {

/// Everything that the control tick and the main loop share. The board apart, nothing else is used by both.
struct TickState {
  explicit TickState(const ParameterSet& set) : drive(set) {}

  /// First, because the tick uses it most and an instruction reaches only so far from the object's beginning.
  Drive drive;
  TickClock clock;
  CheckIn check_in;
  std::int32_t battery_mv = 0;  // as the last tick read it
  FaultWatch faults;
};

}  // namespace astro
