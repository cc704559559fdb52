#pragma once

#include "common/control/trapezoid.hpp"

namespace astro::tests {

/// The limits that the reference robot comes with.
inline constexpr MotionLimits kAstro{750'000, 2'000'000, 500'000, 3'000'000};

inline constexpr std::int64_t kMetre_nm = 1'000'000'000, kTurn_32 = std::int64_t{1} << 32;

}  // namespace astro::tests
