#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host/lidar/stretch.hpp"

namespace astro::lidar {

/// How far the wheels and the scans end up apart over a piece of a drive, both starting at the same pose.
struct PieceError {
  std::size_t first = 0;  // its first stretch
  double distance_m = 0, heading_rad = 0;
};

/// Pieces of `length_m` of driving, by the scans. One begins at each stretch, so that they overlap. Their stretches' scans were
/// matched and show the motion in both directions; a piece that cannot be completed is left out.
std::vector<PieceError> piece_errors(std::span<const Stretch> stretches, double length_m,
                                     const Unknowns& unknowns, const calibration::WheelFactors& loaded);

/// Root mean square of the distances; NaN without pieces.
double rms_m(std::span<const PieceError> errors);

}  // namespace astro::lidar
