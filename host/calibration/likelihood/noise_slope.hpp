#pragma once

#include <Eigen/Core>

#include "host/calibration/likelihood/kalman_filter.hpp"

namespace astro::calibration {

/// Gradient and curvature of -2 log likelihood by the logarithms of K, sigma_xy^2 and sigma_theta^2, with the
/// other unknowns held. The curvature is its expectation, as in Fisher's scoring.
struct NoiseSlope {
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
};

/// Propagates the derivatives of state and covariance by the noise. This includes the change of the
/// innovations by the gain. Without it the slope would be right only at the true noise, and a search that
/// starts elsewhere would end at a wrong noise.
///
/// The derivatives by K and sigma_xy^2 are enough. If all variances grow by one factor, the gains and the state do not change,
/// and each covariance grows by that factor. So the sum of the derivatives by all three noises is zero for the state, and the
/// covariance itself for a covariance.
class NoiseDerivatives final : public Accumulator {
 public:
  explicit NoiseDerivatives(RobustMode robust) : robust_(robust) {}

  void predict(const Prediction& step) override;
  void update(const Update& step, Motion motion) override;

  NoiseSlope slope() const;

 private:
  // `weighted`: the innovation times the weight that it has before Huber's loss in add(), and after it in correct().
  void add(const Update& step, const Vector3& weighted);
  void correct(const Update& step, const Vector3& weighted);

  const RobustMode robust_;
  // Pairs: by K and by sigma_xy^2.
  VectorOf<Pair> state_{};
  SymmetricOf<Pair> covariance_;
  Pair gradient_{}, traces_{};
  double all_gradients_ = 0,
         all_traces_ = 0;  // by all three noises together; each row of the curvature adds up to its trace
  Pair squares_{};         // of the curvature: K with K, sigma_xy^2 with sigma_xy^2
  double K_xy_ = 0;
};

}  // namespace astro::calibration
