#include "host/calibration/likelihood/noise_slope.hpp"

namespace astro::calibration {
namespace {

// Mean of min(d^2, limit) over the mean of d^2 for a normal distribution with 2 and 3 components: how much of
// a variance is left if no sample counts for more than Huber's threshold (his proposal 2). Without the
// threshold, a few samples far out would decide the variance.
double bounded_variance(const Update& step) { return step.has_heading ? 0.99287 : 0.99; }

/// -H v: a change of the state lessens the innovation.
Vector3 seen(const Vector3& v, const Update& step) {
  return {-v[0] + step.lever_y_m * v[2], -v[1] - step.lever_x_m * v[2], step.has_heading ? -v[2] : 0};
}

/// H' v.
Vector3 carried_back(const Vector3& v, const Update& step) {
  return {v[0], v[1], step.lever_x_m * v[1] - step.lever_y_m * v[0] + (step.has_heading ? v[2] : 0)};
}

/// I - K H: what an update leaves of an error of the state.
Matrix3 left_over(const Update& step) {
  Matrix3 out;
  for (std::size_t row = 0; row < 3; ++row) {
    const Vector3 seen = carried_back(step.gain[row], step);
    for (std::size_t col = 0; col < 3; ++col) out[row][col] = (row == col ? 1 : 0) - seen[col];
  }
  return out;
}

double trace(const Matrix3& a) { return a[0][0] + a[1][1] + a[2][2]; }

/// Of a b.
double trace_of_product(const Matrix3& a, const Matrix3& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += a[i][0] * b[0][i] + a[i][1] * b[1][i] + a[i][2] * b[2][i];
  return sum;
}

}  // namespace

void NoiseDerivatives::predict(const Prediction& step) {
  for (std::size_t i = 0; i < kFollowed; ++i) {
    covariance_[i] = sheared(covariance_[i], -step.dy_m, step.dx_m);
    state_[i][0] -= step.dy_m * state_[i][2];
    state_[i][1] += step.dx_m * state_[i][2];
  }
  covariance_[0] += step.slip_covariance;
}

void NoiseDerivatives::update(const Update& step, Motion) {
  add(step);
  correct(step);
}

/// The derivative P of the state's covariance by one noise, and T of the tracker's, become (I - K H) P (I - K H)' + K T K' with the
/// gain K, because at the best gain the covariance does not change with it. The gain changes by ((I - K H) P H' - K T) S^-1,
/// where S is the innovation's covariance. The factors of Huber's loss are held.
void NoiseDerivatives::correct(const Update& step) {
  const Matrix3 left = left_over(step);
  const Vector3 weighted = product(step.weight, step.innovation), back = carried_back(weighted, step);
  for (std::size_t i = 0; i < kFollowed; ++i) {
    covariance_[i] *= step.loss.slip;
    const Vector3 by_gain = product(covariance_[i], back);
    for (std::size_t k = 0; k < 3; ++k) state_[i][k] += by_gain[k];
    state_[i] = product(left, state_[i]);
    covariance_[i] = symmetric_product(product(left, covariance_[i]), left);
  }
  // Of the tracker, only the position's variance is among the noises that are followed.
  const double xy = step.loss.tracker * step.tracker_covariance.xx;
  const Matrix3& k = step.gain;
  const auto both = [&](std::size_t i, std::size_t j) {
    return xy * (k[i][0] * k[j][0] + k[i][1] * k[j][1]);
  };
  for (std::size_t i = 0; i < 3; ++i) state_[1][i] -= xy * (k[i][0] * weighted[0] + k[i][1] * weighted[1]);
  covariance_[1] += Symmetric3{both(0, 0), both(0, 1), both(0, 2), both(1, 1), both(1, 2), both(2, 2)};
}

/// With S the innovation's covariance and A_i = S^-1 dS/d(noise i), the gradient has the traces of A_i and the expected curvature
/// those of A_i A_k.
void NoiseDerivatives::add(const Update& step) {
  const Symmetric3& weight = step.expected_weight;
  const Vector3 v0 = seen(state_[0], step), v1 = seen(state_[1], step);
  const Symmetric3 s0 = step.seen(covariance_[0]);
  Symmetric3 s1 = step.seen(covariance_[1]);
  s1.xx += step.tracker_covariance.xx;
  s1.yy += step.tracker_covariance.xx;
  const Matrix3 a0 = product(weight.full(), s0), a1 = product(weight.full(), s1);
  const Vector3 weighted = product(weight, step.innovation);
  const Vector3 weighted_v0 = product(weight, v0), weighted_v1 = product(weight, v1);
  const double trust = step.is_outlier ? huber_limit(step) / step.expected_chi_square : 1;
  const double bounded = robust_ == RobustMode::none ? 1 : bounded_variance(step);

  const double trace0 = bounded * trace(a0), trace1 = bounded * trace(a1),
               traces = bounded * step.components();
  traces_.add(trace0, trace1, traces);
  gradient_.add(trace0 + trust * (2 * dot(weighted, v0) - dot(weighted, product(s0, weighted))),
                trace1 + trust * (2 * dot(weighted, v1) - dot(weighted, product(s1, weighted))),
                traces - trust * step.expected_chi_square);
  K_K_ += bounded * trace_of_product(a0, a0) + 2 * trust * dot(weighted_v0, v0);
  K_xy_ += bounded * trace_of_product(a0, a1) + 2 * trust * dot(weighted_v0, v1);
  xy_xy_ += bounded * trace_of_product(a1, a1) + 2 * trust * dot(weighted_v1, v1);
}

NoiseSlope NoiseDerivatives::slope() const {
  const double K_theta = traces_.K - K_K_ - K_xy_, xy_theta = traces_.xy - K_xy_ - xy_xy_;
  NoiseSlope out;
  out.gradient = gradient_.all();
  out.curvature << K_K_, K_xy_, K_theta, K_xy_, xy_xy_, xy_theta, K_theta, xy_theta,
      traces_.all()[2] - K_theta - xy_theta;
  return out;
}

}  // namespace astro::calibration
