#pragma once

#include <span>

#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// Travel from speeds, by trapezoids: the samples of `track` become the integral of `speeds`, whose left and right are per
/// second. A remark says how uncertain the sampling leaves the travel: the same is done with every other speed, and a third of
/// what each two steps differ by is the error of one (Richardson), as if these errors were independent.
void integrate(std::span<const WheelSample> speeds, WheelTrack& track);

}  // namespace astro::importing
