#include "host/calibration/likelihood/pose_uncertainty.hpp"

#include <algorithm>
#include <cmath>

namespace astro::calibration {
namespace {

/// A standing wheel may flicker between two counts for hours; that does not count as travel with slip.
constexpr double kFlicker_m = 2e-3;

/// J C J'.
Symmetric3 of_factors(const Move& move, const FactorCovariance& covariance) {
  Symmetric3 sum;
  for (int i = 0; i < kFactors; ++i) {
    for (int k = 0; k < kFactors; ++k) {
      const Vector3 &a = move.by[static_cast<std::size_t>(i)], &b = move.by[static_cast<std::size_t>(k)];
      const double c = covariance(i, k);
      sum += Symmetric3{c * a[0] * b[0], c * a[0] * b[1], c * a[0] * b[2],
                        c * a[1] * b[1], c * a[1] * b[2], c * a[2] * b[2]};
    }
  }
  return sum;
}

}  // namespace

void PoseUncertainty::restart(double heading_rad, const Symmetric3& start) {
  heading_rad_ = heading_rad;
  start_ = start;
  way_ = {};
  right_m_ = left_m_ = 0;
}

void PoseUncertainty::travel(double right_m, double left_m) {
  right_m_ += right_m;
  left_m_ += left_m;
  if (std::max(std::abs(right_m_), std::abs(left_m_)) < kFlicker_m) return;
  way_ = whole();
  right_m_ = left_m_ = 0;
}

Move PoseUncertainty::whole() const { return joined(way_, move_of(right_m_, left_m_, factors_)); }

Symmetric3 PoseUncertainty::covariance() const {
  const Move move = whole();
  const double c = std::cos(heading_rad_), s = std::sin(heading_rad_);
  const double dx_m = c * move.x_m - s * move.y_m, dy_m = s * move.x_m + c * move.y_m;
  return sheared(start_, -dy_m, dx_m) +
         rotated(errors_.K_m * move.slip_per_K + of_factors(move, errors_.factors), c, s);
}

}  // namespace astro::calibration
