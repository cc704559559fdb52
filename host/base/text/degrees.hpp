#pragma once

#include <numbers>

namespace astro {

/// For texts that people read and write; computations use radians.
constexpr double degrees(double radians) { return radians * 180 / std::numbers::pi; }
constexpr double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

}  // namespace astro
