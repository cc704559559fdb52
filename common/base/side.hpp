#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace astro {

/// Of the robot, seen in its direction of travel.
enum class Side : std::uint8_t { left, right };

inline constexpr std::array kSides{Side::left, Side::right};

/// Index of an array with one element for each side, left first.
constexpr std::size_t at(Side side) { return static_cast<std::size_t>(side); }
constexpr Side other(Side side) { return side == Side::left ? Side::right : Side::left; }
constexpr const char* name(Side side) { return side == Side::left ? "left" : "right"; }

}  // namespace astro
