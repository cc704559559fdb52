#include "host/calibration/likelihood/noise_slope.hpp"

namespace astro::calibration {
namespace {

// Mean of min(d^2, limit) over the mean of d^2 for a normal distribution with 2 and 3 components: how much of
// a variance is left if no sample counts for more than Huber's threshold (his proposal 2). Without the
// threshold, a few samples far out would decide the variance.
double bounded_variance(const Update& step) { return step.has_heading ? 0.99287 : 0.99; }

Pair by_K(double value) { return Pair{value, 0}; }
Pair by_xy(double value) { return Pair{0, value}; }

/// -H v: a change of the state lessens the innovation.
VectorOf<Pair> seen(const VectorOf<Pair>& v, const Update& step) {
  return {-v[0] + step.lever_y_m * v[2], -v[1] - step.lever_x_m * v[2], step.has_heading ? -v[2] : Pair{}};
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

Pair trace(const MatrixOf<Pair>& a) { return a[0][0] + a[1][1] + a[2][2]; }

/// The trace of a a, for each one of the pair.
Pair trace_of_square(const MatrixOf<Pair>& a) {
  return a[0][0] * a[0][0] + a[1][1] * a[1][1] + a[2][2] * a[2][2] +
         2.0 * (a[0][1] * a[1][0] + a[0][2] * a[2][0] + a[1][2] * a[2][1]);
}

Pair swapped(const Pair& pair) { return Pair{pair[1], pair[0]}; }

/// The trace of the product of both matrices of the pair.
double trace_of_product(const MatrixOf<Pair>& a) {
  const Pair diagonal = a[0][0] * swapped(a[0][0]) + a[1][1] * swapped(a[1][1]) + a[2][2] * swapped(a[2][2]);
  const Pair rest = a[0][1] * swapped(a[1][0]) + a[0][2] * swapped(a[2][0]) + a[1][2] * swapped(a[2][1]);
  return diagonal[0] + rest[0] + rest[1];
}

}  // namespace

void NoiseDerivatives::predict(const Prediction& step) {
  covariance_ = sheared(covariance_, -step.dy_m, step.dx_m);
  state_[0] -= step.dy_m * state_[2];
  state_[1] += step.dx_m * state_[2];
  const Symmetric3& slip = step.slip_covariance;
  covariance_ += {by_K(slip.xx), by_K(slip.xy), by_K(slip.xt), by_K(slip.yy), by_K(slip.yt), by_K(slip.tt)};
}

void NoiseDerivatives::update(const Update& step, Motion) {
  const Vector3 weighted = product(step.expected_weight, step.innovation);
  add(step, weighted);
  correct(step, step.is_outlier ? product(step.weight, step.innovation) : weighted);
}

/// The derivative P of the state's covariance by one noise, and T of the tracker's, become (I - K H) P (I - K H)' + K T K' with
/// the gain K, because at the best gain the covariance does not change with it. The gain changes by ((I - K H) P H' - K T)
/// S^-1, where S is the innovation's covariance. The factors of Huber's loss are held.
void NoiseDerivatives::correct(const Update& step, const Vector3& weighted) {
  const Matrix3 left = left_over(step);
  const Vector3 back = carried_back(weighted, step);
  if (step.is_outlier) covariance_ *= step.loss.slip;
  const VectorOf<Pair> by_gain = product(covariance_, back);
  for (std::size_t i = 0; i < 3; ++i) state_[i] += by_gain[i];
  state_ = product(left, state_);
  covariance_ = symmetric_product(product(left, covariance_), left);
  // Of the tracker's noises, only the variance of the position is followed.
  const double xy = step.loss.tracker * step.tracker_covariance.xx;
  const Matrix3& k = step.gain;
  const auto both = [&](std::size_t i, std::size_t j) {
    return by_xy(xy * (k[i][0] * k[j][0] + k[i][1] * k[j][1]));
  };
  for (std::size_t i = 0; i < 3; ++i)
    state_[i] -= by_xy(xy * (k[i][0] * weighted[0] + k[i][1] * weighted[1]));
  covariance_ += {both(0, 0), both(0, 1), both(0, 2), both(1, 1), both(1, 2), both(2, 2)};
}

/// With S the innovation's covariance and A_i = S^-1 dS/d(noise i), the gradient has the traces of A_i and the expected curvature
/// those of A_i A_k.
void NoiseDerivatives::add(const Update& step, const Vector3& weighted) {
  const Symmetric3& weight = step.expected_weight;
  const VectorOf<Pair> v = seen(state_, step);
  SymmetricOf<Pair> s = step.seen(covariance_);
  s.xx += by_xy(step.tracker_covariance.xx);
  s.yy += by_xy(step.tracker_covariance.xx);
  const MatrixOf<Pair> a = product(weight.full(), s);
  const VectorOf<Pair> weighted_v = product(weight, v);
  const double trust = step.is_outlier ? huber_limit(step) / step.expected_chi_square : 1;
  const double bounded = robust_ == RobustMode::none ? 1 : bounded_variance(step);

  const Pair traces = bounded * trace(a);
  traces_ += traces;
  gradient_ += traces + trust * (2.0 * dot(weighted, v) - dot(weighted, product(s, weighted)));
  const double all = bounded * step.components();
  all_traces_ += all;
  all_gradients_ += all - trust * step.expected_chi_square;
  squares_ += bounded * trace_of_square(a) + 2.0 * trust * dot(weighted_v, v);
  const Pair crossed =
      weighted_v[0] * swapped(v[0]) + weighted_v[1] * swapped(v[1]) + weighted_v[2] * swapped(v[2]);
  K_xy_ += bounded * trace_of_product(a) + 2 * trust * crossed[0];
}

NoiseSlope NoiseDerivatives::slope() const {
  const double K_K = squares_[0], xy_xy = squares_[1];
  const double K_theta = traces_[0] - K_K - K_xy_, xy_theta = traces_[1] - K_xy_ - xy_xy;
  const double theta_theta = all_traces_ - traces_[0] - traces_[1] - K_theta - xy_theta;
  NoiseSlope out;
  out.gradient << gradient_[0], gradient_[1], all_gradients_ - gradient_[0] - gradient_[1];
  out.curvature << K_K, K_xy_, K_theta, K_xy_, xy_xy, xy_theta, K_theta, xy_theta, theta_theta;
  return out;
}

}  // namespace astro::calibration
