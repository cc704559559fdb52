#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace astro::motor {

enum class Side : std::uint8_t { left, right };
inline constexpr std::array kSides{Side::left, Side::right};
constexpr std::size_t at(Side side) { return static_cast<std::size_t>(side); }
constexpr Side other(Side side) { return side == Side::left ? Side::right : Side::left; }
constexpr const char* name(Side side) { return side == Side::left ? "left" : "right"; }

/// One wheel at one control tick. The voltage is on the motor from this sample to the next.
struct Sample {
  double time_s = 0;
  double voltage_V = 0;   // duty times supply, forward positive
  double position_m = 0;  // counts times travel per count: it goes in steps
};

}  // namespace astro::motor
