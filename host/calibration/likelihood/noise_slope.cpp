#include "host/calibration/likelihood/noise_slope.hpp"

#include <cmath>

#include "host/calibration/likelihood/kalman_filter.hpp"

namespace astro::calibration {
namespace {

using Eigen::Matrix3d;

constexpr int kNoises = NoiseSlope::kNoises;
using PerNoise = Eigen::Matrix<double, 3, kNoises>;  // a column for each noise

// Mean of min(d^2, limit) over the mean of d^2 for a normal distribution with 2 and 3 components: how much of
// a variance is left if no sample counts for more than Huber's threshold (his proposal 2). Without the
// threshold, a few samples far out would decide the variance.
double bounded_variance(const Update& step) { return step.has_heading ? 0.99287 : 0.99; }

/// Propagates the derivatives of state and covariance by the noise. Those of the innovations by the gain are
/// part of it: without them the slope would be right for the true model alone and lead to the wrong noise
/// from every other one.
class NoiseDerivatives final : public Accumulator {
 public:
  NoiseDerivatives(const NoiseModel& noise, RobustMode robust) : noise_(noise), robust_(robust) {
    for (Matrix3d& derivative : covariance_) derivative.setZero();
  }

  void predict(const Prediction& step) override {
    for (Matrix3d& derivative : covariance_)
      derivative = step.transition * derivative * step.transition.transpose();
    covariance_[0] += step.slip_covariance;
    state_.row(0) += step.transition(0, 2) * state_.row(2);
    state_.row(1) += step.transition(1, 2) * state_.row(2);
  }

  void update(const Update& step, Motion) override {
    const Matrix3d& h = step.jacobian_state;
    const PerNoise innovation = -h * state_;
    Matrix3d tracker[kNoises] = {Matrix3d::Zero(), xy_covariance(), theta_covariance(step)};
    Matrix3d slopes[kNoises];
    for (int i = 0; i < kNoises; ++i) slopes[i] = h * covariance_[i] * h.transpose() + tracker[i];
    add(step, slopes, innovation);
    if (step.is_outlier)  // the factors of Huber's loss are held
      for (int i = 0; i < kNoises; ++i) {
        tracker[i] *= step.loss.tracker;
        covariance_[i] *= step.loss.slip;
      }
    const Matrix3d keep = Matrix3d::Identity() - step.gain * h;
    const Eigen::Vector3d weighted = step.weight * step.innovation;
    for (int i = 0; i < kNoises; ++i) {
      state_.col(i) += (keep * covariance_[i] * h.transpose() - step.gain * tracker[i]) * weighted +
                       step.gain * innovation.col(i);
      covariance_[i] =
          keep * covariance_[i] * keep.transpose() + step.gain * tracker[i] * step.gain.transpose();
    }
  }

  NoiseSlope slope;

 private:
  Matrix3d xy_covariance() const {
    const double variance = noise_.sigma_xy_m * noise_.sigma_xy_m;
    return Eigen::Vector3d(variance, variance, 0).asDiagonal();
  }

  Matrix3d theta_covariance(const Update& step) const {
    return Eigen::Vector3d(0, 0, step.has_heading ? noise_.sigma_theta_rad * noise_.sigma_theta_rad : 0)
        .asDiagonal();
  }

  /// `slopes`: derivatives of the innovation's covariance; `innovation`: of the innovation itself.
  void add(const Update& step, const Matrix3d (&slopes)[kNoises], const PerNoise& innovation) {
    const auto& weight = step.expected_weight;
    const double trust = step.is_outlier ? huber_limit(step) / step.expected_chi_square : 1;
    const double bounded = robust_ == RobustMode::none ? 1 : bounded_variance(step);
    const Eigen::Vector3d weighted = weight * step.innovation;
    Matrix3d weighted_slopes[kNoises];
    for (int i = 0; i < kNoises; ++i) {
      weighted_slopes[i] = weight * slopes[i];
      slope.gradient[i] += bounded * weighted_slopes[i].trace() +
                           trust * (2 * weighted.dot(innovation.col(i)) - weighted.dot(slopes[i] * weighted));
    }
    for (int i = 0; i < kNoises; ++i)
      for (int k = 0; k < kNoises; ++k)
        slope.curvature(i, k) += bounded * (weighted_slopes[i] * weighted_slopes[k]).trace();
    slope.curvature += 2 * trust * innovation.transpose() * weight * innovation;
  }

  const NoiseModel& noise_;
  const RobustMode robust_;
  PerNoise state_ = PerNoise::Zero();
  Matrix3d covariance_[kNoises];
};

}  // namespace

NoiseSlope noise_slope(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise,
                       RobustMode robust, const SampleSelection& samples) {
  NoiseDerivatives derivatives(noise, robust);
  filter_run(run, unknowns, noise, robust, TruthUse::values, samples, derivatives);
  return derivatives.slope;
}

}  // namespace astro::calibration
