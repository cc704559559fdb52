#pragma once

#include <numbers>

namespace astro {

/// For people; all that is computed with is in radians.
constexpr double degrees(double radians) { return radians * 180 / std::numbers::pi; }

}  // namespace astro
