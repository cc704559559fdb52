#pragma once

#include <cstdint>

#include "common/fixed/saturate.hpp"

namespace astro {

/// A wheel that turns no faster than this counts as stopped, at a ramp's end as well as for a stall.
///
/// The exact value hardly matters: so slow a wheel makes one count in 27 ms (reference robot), and after each
/// the observed speed is above 3 mm/s for 12 ms and above 2 mm/s for 15 ms. A robot at this speed rolls less
/// than a millimetre on its brakes.
inline constexpr std::int32_t kWheelStopped_umps = 3'000;
constexpr bool wheel_stopped(std::int32_t speed_umps) { return !exceeds(speed_umps, kWheelStopped_umps); }

}  // namespace astro
