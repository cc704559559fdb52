#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "hal/sim/board.hpp"

namespace astro::sim {

inline std::int16_t duty_for(double volts, double supply_V = 12.0) {
  return static_cast<std::int16_t>(std::lround(volts / supply_V * 32767.0));
}

inline void run_ms(Board& board, int ms) {
  for (int i = 0; i < ms; ++i) board.advance_tick();
}

/// A robot without noise and with a stiff supply, for figures that must come out exactly.
inline Config ideal() {
  Config config;
  config.slip_m = 0.0;
  config.supply_ohm = 0.0;
  return config;
}

/// The same with its wheels off the ground.
inline Config on_stand() {
  Config config = ideal();
  config.on_stand = true;
  return config;
}

inline bool at_rest(const Board& board) {
  return board.drivetrain().speed_radps()[0] == 0.0 && board.drivetrain().speed_radps()[1] == 0.0;
}

/// Milliseconds until both wheels stand still.
inline int ms_to_rest(Board& board) {
  int ms = 0;
  while (!at_rest(board) && ms < 60000) {
    board.advance_tick();
    ++ms;
  }
  return ms;
}

/// A drive of two seconds that starts, turns round, coasts and brakes.
inline void eventful_drive(Board& board) {
  for (int ms = 0; ms < 2000; ++ms) {
    if (ms == 900) board.motors().coast();
    if (ms == 1100) board.motors().brake();
    const bool driving = ms < 900 || ms >= 1200;
    const double phase = 0.004 * ms;
    if (driving)
      board.motors().drive({duty_for(9.0 * std::sin(phase)), duty_for(7.0 * std::cos(1.7 * phase))});
    board.advance_tick();
  }
}

}  // namespace astro::sim
