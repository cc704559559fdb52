#include "host/calibration/likelihood/noise_slope.hpp"

#include <array>
#include <cmath>

#include "host/calibration/likelihood/kalman_filter.hpp"

namespace astro::calibration {
namespace {

constexpr std::size_t kNoises = NoiseSlope::kNoises;

// Mean of min(d^2, limit) over the mean of d^2 for a normal distribution with 2 and 3 components: how much of
// a variance is left if no sample counts for more than Huber's threshold (his proposal 2). Without the
// threshold, a few samples far out would decide the variance.
double bounded_variance(const Update& step) { return step.has_heading ? 0.99287 : 0.99; }

/// Propagates the derivatives of state and covariance by the noise. Those of the innovations by the gain are
/// part of it: without them the slope would be right for the true model alone and lead to the wrong noise
/// from every other one.
class NoiseDerivatives final : public Accumulator {
 public:
  explicit NoiseDerivatives(RobustMode robust) : robust_(robust) {}

  void predict(const Prediction& step) override {
    for (std::size_t i = 0; i < kNoises; ++i) {
      covariance_[i] = sheared(covariance_[i], -step.dy_m, step.dx_m);
      state_[i][0] -= step.dy_m * state_[i][2];
      state_[i][1] += step.dx_m * state_[i][2];
    }
    covariance_[0] += step.slip_covariance;
  }

  void update(const Update& step, Motion) override {
    const std::array<Symmetric3, kNoises> tracker = by_noise(step.tracker_covariance, step.has_heading);
    std::array<Symmetric3, kNoises> states;    // of the state's covariance, as the innovation sees it
    std::array<Symmetric3, kNoises> slopes;    // of the innovation's covariance
    std::array<Vector3, kNoises> innovations;  // slopes of the innovation
    for (std::size_t i = 0; i < kNoises; ++i) {
      states[i] = step.seen(covariance_[i]);
      slopes[i] = states[i] + tracker[i];
      innovations[i] = seen(state_[i], step);
    }
    add(step, slopes, innovations);
    const Vector3 weighted = product(step.weight, step.innovation);
    for (std::size_t i = 0; i < kNoises; ++i) {
      // The factors of Huber's loss are held.
      const Symmetric3 held = step.loss.slip * states[i] + step.loss.tracker * tracker[i];
      covariance_[i] *= step.loss.slip;
      correct(step, i, held, weighted, innovations[i]);
    }
  }

  NoiseSlope slope;

 private:
  /// Derivatives of the tracker's covariance by the logarithms of K, sigma_xy^2 and sigma_theta^2.
  static std::array<Symmetric3, kNoises> by_noise(const Symmetric3& tracker, bool has_heading) {
    Symmetric3 xy, theta;
    xy.xx = xy.yy = tracker.xx;
    if (has_heading) theta.tt = tracker.tt;
    return {Symmetric3{}, xy, theta};
  }

  /// -H v: a change of the state lessens the innovation.
  static Vector3 seen(const Vector3& v, const Update& step) {
    return {-v[0] + step.lever_y_m * v[2], -v[1] - step.lever_x_m * v[2], step.has_heading ? -v[2] : 0};
  }

  /// What the gain K does to the derivatives of state and covariance by noise i. With P the derivative of the covariance and
  /// S = H P H' + T that of the innovation's, the gain changes by (P H' - K S) S_innovation^-1, and (I - K H) P (I - K H)' + K T K'
  /// is P - K H P - P H' K' + K S K'.
  void correct(const Update& step, std::size_t i, const Symmetric3& seen_slope, const Vector3& weighted,
               const Vector3& innovation) {
    const Matrix3 ph = step.with_state(covariance_[i]), ks = product(step.gain, seen_slope);
    Matrix3 left_over;  // P H' - K S / 2: its product with K', with the transpose added, is what leaves P
    for (std::size_t row = 0; row < 3; ++row) {
      state_[i][row] += dot(ph[row], weighted) - dot(ks[row], weighted) + dot(step.gain[row], innovation);
      for (std::size_t col = 0; col < 3; ++col) left_over[row][col] = ph[row][col] - ks[row][col] / 2;
    }
    const Matrix3& k = step.gain;
    const Matrix3& m = left_over;
    covariance_[i] += Symmetric3{
        -2 * dot(m[0], k[0]), -dot(m[0], k[1]) - dot(m[1], k[0]), -dot(m[0], k[2]) - dot(m[2], k[0]),
        -2 * dot(m[1], k[1]), -dot(m[1], k[2]) - dot(m[2], k[1]), -2 * dot(m[2], k[2])};
  }

  /// `slopes`: derivatives of the innovation's covariance; `innovations`: of the innovation itself.
  void add(const Update& step, const std::array<Symmetric3, kNoises>& slopes,
           const std::array<Vector3, kNoises>& innovations) {
    const Symmetric3& weight = step.expected_weight;
    const double trust = step.is_outlier ? huber_limit(step) / step.expected_chi_square : 1;
    const double bounded = robust_ == RobustMode::none ? 1 : bounded_variance(step);
    const Vector3 weighted = product(weight, step.innovation);
    for (std::size_t i = 0; i < kNoises; ++i) {
      slope.gradient[static_cast<Eigen::Index>(i)] +=
          bounded * trace_of_product(weight, slopes[i]) +
          trust * (2 * dot(weighted, innovations[i]) - dot(weighted, product(slopes[i], weighted)));
      // weight slope weight, whose trace with another slope is the expected curvature.
      const Symmetric3 both = symmetric_product(product(weight.full(), slopes[i]), weight.full());
      const Vector3 weighted_slope = product(weight, innovations[i]);
      for (std::size_t k = 0; k < kNoises; ++k)
        slope.curvature(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) +=
            bounded * trace_of_product(both, slopes[k]) + 2 * trust * dot(weighted_slope, innovations[k]);
    }
  }

  const RobustMode robust_;
  std::array<Vector3, kNoises> state_{};
  std::array<Symmetric3, kNoises> covariance_{};
};

}  // namespace

NoiseSlope noise_slope(const Moves& moves, const NoiseModel& noise, RobustMode robust,
                       const SampleSelection& samples) {
  NoiseDerivatives derivatives(robust);
  filter_run(moves, noise, robust, TruthUse::values, samples, derivatives);
  return derivatives.slope;
}

}  // namespace astro::calibration
