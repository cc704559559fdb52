#include "host/calibration/judgement/precision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "host/base/error.hpp"

namespace astro::calibration {
namespace {

void require_positive(double value, const std::string& what) {
  if (std::isfinite(value) && value > 0) return;
  throw Error(what + " is " + std::to_string(value) + ": give a positive number");
}

}  // namespace

DriveExtent squares_extent(int runs, double side_m) {
  require_positive(runs, "the number of squares");
  require_positive(side_m, "the side of the square in metres");
  return {runs * 4 * side_m, runs * 2 * std::numbers::pi};
}

Precision reachable_precision(const DriveExtent& extent, double K_m, double b_m) {
  require_positive(extent.distance_m, "the distance in metres");
  require_positive(extent.rotation_rad, "the rotation in radians");
  require_positive(K_m, "the wheel slip K in metres");
  require_positive(b_m, "the wheelbase in metres");
  return {std::sqrt(2 * K_m / extent.distance_m), std::sqrt(K_m / (2 * extent.distance_m)),
          std::sqrt(K_m / (b_m * extent.rotation_rad))};
}

int squares_needed(const Precision& target, double side_m, double K_m, double b_m) {
  require_positive(target.E_d, "the precision wanted of E_d");
  require_positive(target.scale, "the precision wanted of the scale");
  require_positive(target.b, "the precision wanted of the wheelbase");
  const Precision one = reachable_precision(squares_extent(1, side_m), K_m, b_m);
  const double worst = std::max({one.E_d / target.E_d, one.scale / target.scale, one.b / target.b});
  // A target that is met exactly must not cost one more run for a rounding.
  const double runs = std::max(1.0, std::ceil(worst * worst * (1 - 1e-12)));
  if (runs > std::numeric_limits<int>::max()) {
    throw Error(
        "no number of squares reaches a precision this fine: ask for less, or drive where the wheels slip "
        "less");
  }
  return static_cast<int>(runs);
}

}  // namespace astro::calibration
