#include "host/live/driver/twist_uncertainty.hpp"

#include <array>
#include <cmath>

#include "common/kinematics/geometry.hpp"
#include "host/calibration/motion/arc.hpp"

namespace astro::live {
namespace {

/// Derivatives of v and omega by c_R, c_L, b and e.
struct ByFactors {
  std::array<double, 4> v{}, omega{};
};

ByFactors by_factors(double right_mps, double left_mps, const calibration::WheelFactors& factors) {
  const double base_m = calibration::effective_wheelbase_m(right_mps, left_mps, factors);
  const double omega_radps = (right_mps - left_mps) / base_m;
  const double straightness =
      right_mps == 0 && left_mps == 0 ? 0 : calibration::straightness(right_mps, left_mps, factors.kappa0);
  return {{right_mps / factors.c_r / 2, left_mps / factors.c_l / 2, 0, 0},
          {right_mps / factors.c_r / base_m, -left_mps / factors.c_l / base_m, -omega_radps / factors.b_m,
           -omega_radps * straightness / (1 + factors.e * straightness)}};
}

}  // namespace

double count_ripple_variance(const OdometryGeometry& geometry) {
  constexpr double kLargest = 0.0158;  // 0.312 / (2 pi^2)
  const double w = geometry.observer_bandwidth_radps, speed_mps = w * geometry.count_m;
  return kLargest * speed_mps * speed_mps / (1 - w / kTickHz);
}

TwistCovariance twist_covariance(double v_mps, double omega_radps, double period_s,
                                 const OdometryGeometry& geometry,
                                 const calibration::OdometryErrors& errors) {
  const double b_m = geometry.factors.b_m;
  const double right_mps = v_mps + omega_radps * b_m / 2, left_mps = v_mps - omega_radps * b_m / 2;
  const double ripple = count_ripple_variance(geometry), per_speed = errors.K_m / period_s;
  const double right = ripple + per_speed * std::abs(right_mps);
  const double left = ripple + per_speed * std::abs(left_mps);
  TwistCovariance sum{(right + left) / 4, (right - left) / (2 * b_m), (right + left) / (b_m * b_m)};
  const ByFactors by = by_factors(right_mps, left_mps, geometry.factors);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double c = errors.factors(static_cast<int>(i), static_cast<int>(k));
      sum.vv += c * by.v[i] * by.v[k];
      sum.vw += c * by.v[i] * by.omega[k];
      sum.ww += c * by.omega[i] * by.omega[k];
    }
  }
  return sum;
}

double gyro_rate_variance(double omega_radps, const calibration::GyroErrors& errors) {
  constexpr double kMean_s = 0.01, kLearn_s = 0.5;
  const double walk = errors.random_walk_rad * errors.random_walk_rad,
               scale_radps = errors.scale * omega_radps;
  return walk / kMean_s + walk / kLearn_s + scale_radps * scale_radps;
}

}  // namespace astro::live
