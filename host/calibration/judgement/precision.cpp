#include "host/calibration/judgement/precision.hpp"

#include <cmath>
#include <string>

#include "host/base/require_positive.hpp"

namespace astro::calibration {

Precision reachable_precision(const DriveExtent& extent, double K_m, double b_m) {
  require_positive(extent.distance_m, "the distance in metres");
  require_positive(extent.rotation_rad, "the rotation in radians");
  require_positive(K_m, "the wheel slip K in metres");
  require_positive(b_m, "the wheelbase in metres");
  return {std::sqrt(2 * K_m / extent.distance_m), std::sqrt(K_m / (2 * extent.distance_m)),
          std::sqrt(K_m / (b_m * extent.rotation_rad))};
}

}  // namespace astro::calibration
