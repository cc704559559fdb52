#pragma once

#include <cmath>

namespace astro::experiment {

/// Whether two values of a factor, a length in metres or a ratio near 1 are the same number: the tolerance is above one
/// step of the wire format and far below what a calibration changes.
inline bool same_number(double a, double b) { return std::abs(a - b) < 1e-8; }

}  // namespace astro::experiment
