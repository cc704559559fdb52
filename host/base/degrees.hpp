#pragma once

#include <numbers>

namespace astro {

/// For texts that people read; computations use radians.
constexpr double degrees(double radians) { return radians * 180 / std::numbers::pi; }

}  // namespace astro
