#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "host/calibration/likelihood/kalman_filter.hpp"

namespace astro::calibration {

/// Gradient and curvature of -2 log likelihood by the logarithms of K, sigma_xy^2 and sigma_theta^2, with the
/// other unknowns held. The curvature is its expectation, as in Fisher's scoring.
struct NoiseSlope {
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
};

/// Propagates the derivatives of state and covariance by the noise. Those of the innovations by the gain are
/// part of it: without them the slope would be right for the true model alone and lead to the wrong noise
/// from every other one.
///
/// The derivatives by K and sigma_xy^2 are enough. If all variances grow alike, the gains and with them the state stay as they are,
/// and each covariance grows as the variances do: so the derivatives by all three noises add up to zero and to the covariance.
class NoiseDerivatives final : public Accumulator {
 public:
  explicit NoiseDerivatives(RobustMode robust) : robust_(robust) {}

  void predict(const Prediction& step) override;
  void update(const Update& step, Motion motion) override;

  NoiseSlope slope() const;

 private:
  static constexpr std::size_t kFollowed = 2;  // K, sigma_xy^2
  /// One number for each of these noises, and what they and that of sigma_theta^2 add up to.
  struct PerNoise {
    double K = 0, xy = 0, sum = 0;

    void add(double by_K, double by_xy, double of_all) { K += by_K, xy += by_xy, sum += of_all; }
    Eigen::Vector3d all() const { return {K, xy, sum - K - xy}; }
  };

  void add(const Update& step);
  void correct(const Update& step);

  const RobustMode robust_;
  std::array<Vector3, kFollowed> state_{};
  std::array<Symmetric3, kFollowed> covariance_{};
  PerNoise gradient_, traces_;             // traces: each row of the curvature adds up to its own
  double K_K_ = 0, K_xy_ = 0, xy_xy_ = 0;  // of the curvature
};

}  // namespace astro::calibration
