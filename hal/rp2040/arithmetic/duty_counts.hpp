#pragma once

#include <cstdint>

namespace astro::rp2040 {

/// One PWM period: 20 kHz from the 125 MHz system clock. Above hearing, and slow enough for the driver chips.
inline constexpr std::uint32_t kPwmPeriod_counts = 6250;

/// How many counts of a period the two inputs of a bridge are high, from its beginning.
///
///   IN1 IN2
///    1   0     forward
///    0   1     reverse
///    1   1     short brake
///    0   0     open
///
/// One input is high all the time and the other one while the motor brakes, so the motor sees duty times supply and never
/// the other direction.
struct BridgeCounts {
  std::uint32_t in1 = 0, in2 = 0;
  friend constexpr bool operator==(const BridgeCounts&, const BridgeCounts&) = default;
};

inline constexpr BridgeCounts kOpen{0, 0}, kBrake{kPwmPeriod_counts, kPwmPeriod_counts};

/// Of a duty in Q15, to the nearest count. Full drive, +-32767, never brakes. -32768, which is not a valid duty, is full
/// drive.
constexpr BridgeCounts bridge_counts(std::int16_t duty) {
  constexpr std::uint32_t kFull = 32767;
  const std::uint32_t magnitude =
      duty < 0 ? static_cast<std::uint32_t>(-std::int32_t{duty}) : static_cast<std::uint32_t>(duty);
  const std::uint32_t driven =
      magnitude >= kFull ? kPwmPeriod_counts : (magnitude * kPwmPeriod_counts + kFull / 2) / kFull;
  const std::uint32_t braked = kPwmPeriod_counts - driven;
  return duty < 0 ? BridgeCounts{braked, kPwmPeriod_counts} : BridgeCounts{kPwmPeriod_counts, braked};
}

}  // namespace astro::rp2040
