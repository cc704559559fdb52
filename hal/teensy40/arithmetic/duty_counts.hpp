#pragma once

#include <cstdint>

namespace astro::teensy40 {

/// One PWM period: 20 kHz from the 150 MHz bus clock. Above hearing, and slow enough for the driver chip.
inline constexpr std::uint32_t kPwmPeriod_counts = 7500;

/// The high time in a PWM period for a duty in Q15, to the nearest count; the direction pins take care of the
/// sign. Full drive, +-32767, is the whole period, so the output never goes low. -32768, which is not a valid
/// duty, is full drive.
constexpr std::uint32_t duty_counts(std::int16_t duty) {
  constexpr std::uint32_t kFull = 32767;
  const std::uint32_t magnitude =
      duty < 0 ? static_cast<std::uint32_t>(-std::int32_t{duty}) : static_cast<std::uint32_t>(duty);
  if (magnitude >= kFull) return kPwmPeriod_counts;
  return (magnitude * kPwmPeriod_counts + kFull / 2) / kFull;
}

}  // namespace astro::teensy40
