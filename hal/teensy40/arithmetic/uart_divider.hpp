#pragma once

#include <cstdint>

#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40 {

/// How an LPUART divides its clock: baud = clock / (samples * divisor).
struct UartDivider {
  std::uint32_t samples = 0;  // per bit, 4..32
  std::uint32_t divisor = 0;  // 1..8191

  constexpr std::uint32_t total() const { return samples * divisor; }

  /// The word of the BAUD register: 8N1, both edges where there are too few samples for one.
  constexpr std::uint32_t baud_register() const {
    return lpuart::BAUD_OSR(samples - 1) | lpuart::BAUD_SBR(divisor) | lpuart::BAUD_BOTHEDGE(samples < 8);
  }
};

/// The division that comes closest to `baud`; among equals the one with most samples per bit.
constexpr UartDivider uart_divider(std::uint32_t clock_Hz, std::uint32_t baud) {
  UartDivider best;
  std::uint32_t least = ~0U;
  for (std::uint32_t samples = 32; samples >= 4; --samples) {
    const std::uint32_t divisor = (clock_Hz + baud * samples / 2) / (baud * samples);
    if (divisor == 0 || divisor > 8191) continue;
    const std::uint32_t got = baud * samples * divisor;
    const std::uint32_t error = got > clock_Hz ? got - clock_Hz : clock_Hz - got;
    if (error >= least) continue;
    least = error;
    best = {samples, divisor};
  }
  return best;
}

}  // namespace astro::teensy40
