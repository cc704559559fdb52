#include "host/calibration/likelihood/noise_slope.hpp"

#include <cmath>

#include "host/calibration/likelihood/kalman_filter.hpp"

namespace astro::calibration {
namespace {

using Eigen::Matrix3d;

constexpr int kNoises = NoiseSlope::kNoises;
// Mean of min(d^2, limit) over the mean of d^2 for a normal distribution with 2 and 3 components: how much of
// a variance is left if no sample counts for more than Huber's threshold (his proposal 2). Without the
// threshold, a few samples far out would decide the variance.
template <int N>
constexpr double kBoundedVariance = N == 3 ? 0.99287 : 0.99;

/// Propagates the derivatives of state and covariance by the noise. Those of the innovations by the gain are
/// part of it: without them the slope would be right for the true model alone and lead to the wrong noise
/// from every other one.
class NoiseDerivatives {
 public:
  NoiseDerivatives(const NoiseModel& noise, RobustMode robust) : noise_(noise), robust_(robust) {
    for (Matrix3d& derivative : covariance_) derivative.setZero();
  }

  void predict(const Prediction& step) {
    for (Matrix3d& derivative : covariance_)
      derivative = step.transition * derivative * step.transition.transpose();
    covariance_[0] += step.slip_covariance;
    state_.row(0) += step.transition(0, 2) * state_.row(2);
    state_.row(1) += step.transition(1, 2) * state_.row(2);
  }

  template <int N>
  void update(const Update<N>& step, const BodySample&, Motion) {
    using Square = typename Update<N>::Square;
    const auto& h = step.jacobian_state;
    const Eigen::Matrix<double, N, kNoises> innovation = -h * state_;
    Square tracker[kNoises] = {Square::Zero(), xy_covariance<N>(), theta_covariance<N>()};
    Square slopes[kNoises];
    for (int i = 0; i < kNoises; ++i) slopes[i] = h * covariance_[i] * h.transpose() + tracker[i];
    add(step, slopes, innovation);
    if (step.is_outlier)  // the factors of Huber's loss are held
      for (int i = 0; i < kNoises; ++i) {
        tracker[i] *= step.loss.tracker;
        covariance_[i] *= step.loss.slip;
      }
    const Matrix3d keep = Matrix3d::Identity() - step.gain * h;
    const typename Update<N>::Vector weighted = step.weight * step.innovation;
    for (int i = 0; i < kNoises; ++i) {
      state_.col(i) += (keep * covariance_[i] * h.transpose() - step.gain * tracker[i]) * weighted +
                       step.gain * innovation.col(i);
      covariance_[i] =
          keep * covariance_[i] * keep.transpose() + step.gain * tracker[i] * step.gain.transpose();
    }
  }

  NoiseSlope slope;

 private:
  template <int N>
  typename Update<N>::Square xy_covariance() const {
    typename Update<N>::Square covariance = Update<N>::Square::Zero();
    covariance(0, 0) = covariance(1, 1) = noise_.sigma_xy_m * noise_.sigma_xy_m;
    return covariance;
  }

  template <int N>
  typename Update<N>::Square theta_covariance() const {
    typename Update<N>::Square covariance = Update<N>::Square::Zero();
    if constexpr (N == 3) covariance(2, 2) = noise_.sigma_theta_rad * noise_.sigma_theta_rad;
    return covariance;
  }

  /// `slopes`: derivatives of the innovation's covariance; `innovation`: of the innovation itself.
  template <int N>
  void add(const Update<N>& step, const typename Update<N>::Square (&slopes)[kNoises],
           const Eigen::Matrix<double, N, kNoises>& innovation) {
    const auto& weight = step.expected_weight;
    const double trust = step.is_outlier ? kHuberLimit<N> / step.expected_chi_square : 1;
    const double bounded = robust_ == RobustMode::none ? 1 : kBoundedVariance<N>;
    const typename Update<N>::Vector weighted = weight * step.innovation;
    typename Update<N>::Square weighted_slopes[kNoises];
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
  Eigen::Matrix<double, 3, kNoises> state_ = Eigen::Matrix<double, 3, kNoises>::Zero();
  Matrix3d covariance_[kNoises];
};

}  // namespace

NoiseSlope noise_slope(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise,
                       RobustMode robust, const SampleSelection& samples) {
  NoiseDerivatives derivatives(noise, robust);
  KalmanFilter filter(run, unknowns, noise, robust, TruthUse::values, derivatives);
  filter_run(run, unknowns, samples, filter);
  return derivatives.slope;
}

}  // namespace astro::calibration
