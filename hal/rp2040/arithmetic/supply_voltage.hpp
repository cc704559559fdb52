#pragma once

#include <cstdint>

namespace astro::rp2040 {

/// The motor supply behind its divider, 82 kohm above 10 kohm (1 %), at a converter of 12 bits with a full scale of 3.3 V.
///
/// Why     25 V, a 6S pack, becomes 2.7 V at the pin, which tolerates 3.3 V, or 30.4 V of supply.
inline constexpr std::uint32_t kDividerUpper_ohm = 82'000, kDividerLower_ohm = 10'000;
inline constexpr std::uint32_t kAdcFullScale_mV = 3'300, kAdcFullScale = 4'095;
inline constexpr std::uint32_t kSupplyFullScale_mV =
    kAdcFullScale_mV * ((kDividerUpper_ohm + kDividerLower_ohm) / 1000) / (kDividerLower_ohm / 1000);
static_assert(kSupplyFullScale_mV == 30'360);

/// First-order low pass over samples 1 ms apart, -3 dB at 46 Hz, in sixteenths of a converter step.
class SupplyVoltage {
 public:
  /// Starts at `sample`, so that the first readings do not rise from zero.
  constexpr void prime(std::uint32_t sample) { level_ = static_cast<std::int32_t>(sample << kFraction); }

  constexpr void add(std::uint32_t sample) {
    level_ += (static_cast<std::int32_t>(sample << kFraction) - level_) >> 2;
  }

  /// Error of the arithmetic: below 2 mV; of the resistors: 1.8 % at most.
  ///
  /// Cost    no division, which takes 40 instructions here: a product with the scale in 2^-16 mV, rounded.
  constexpr std::int32_t millivolts() const {
    constexpr std::uint32_t kFull = kAdcFullScale << kFraction;
    constexpr std::uint32_t kScale_16 = ((kSupplyFullScale_mV << 16) + kFull / 2) / kFull;
    return static_cast<std::int32_t>((static_cast<std::uint32_t>(level_) * kScale_16 + (1U << 15)) >> 16);
  }

 private:
  static constexpr int kFraction = 4;
  static_assert((std::uint64_t{kAdcFullScale} << kFraction) * (kSupplyFullScale_mV + 1) < 1ULL << 31,
                "fits a word");

  std::int32_t level_ = 0;
};

}  // namespace astro::rp2040
