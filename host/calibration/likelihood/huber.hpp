#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "host/calibration/likelihood/robust_mode.hpp"

/// Huber's loss for a truth sample after wheels that slip.
///
/// An innovation r is the sum of wheel slip and tracker error, with covariances P and R, and either can have
/// outliers: a marker taken for another, a castor that swings round, a cable on the floor. So the loss is that
/// of the most likely division of r,
///
///   min over e of  rho(e' R^-1 e) + rho((r - e)' P^-1 (r - e)),   rho(q) = q up to limit, then
///                                                                 2 sqrt(limit q) - limit
///   = min over s, t >= 1 of  r' (s P + t R)^-1 r + limit (s - 1) + limit (t - 1).
///
/// Its slope is 2 (s P + t R)^-1 r: the weight that a filter gives a sample if the variance of the slip is s
/// times and that of the tracker t times the usual one. The larger covariance is inflated: without slip t is
/// Huber's sqrt(q / limit) and s is 1; after a stretch without truth it is the other way round. With
/// RobustMode::tracker s stays 1.
/// Source  Huber 1964, Ann. Math. Stat. 35(1), for the loss; Masreliez & Martin 1977 for such a filter.
namespace astro::calibration {

struct HuberLoss {
  double cost = 0;
  double slip = 1, tracker = 1;  // s and t
};

namespace huber_detail {

/// The least x >= 1 for which sum of a y^2 / (x a + b)^2 is within `limit`; all a and b are at least 0.
template <class Array>
double inflation(const Array& y, const Array& a, const Array& b, double limit) {
  double x = 1;
  // The sum is convex and decreasing in x, so Newton's method converges from the left.
  for (int i = 0; i < 100; ++i) {
    const Array total = x * a + b;
    const double excess = (a * (y / total).square()).sum() - limit;
    if (excess <= 1e-12 * limit) break;
    x += excess / (2 * ((a * y).square() / total.cube()).sum());
  }
  return x;
}

/// The least sum of y^2 / (s l + t) + limit (s + t) over s, t >= 1; `t` comes as the best one for s = 1.
template <class Array>
void inflate_both(const Array& y, const Array& l, double limit, double& s, double& t) {
  const Array one = Array::Ones();
  // Derivatives of the cost by s and by t.
  const auto slope = [&](const Array& by, double slip, double tracker) {
    return limit - (by * (y / (slip * l + tracker)).square()).sum();
  };
  constexpr double kFlat = 1e-9;
  if (slope(l, s, t) >= -kFlat * limit) return;
  s = inflation<Array>(y, l, one, limit);
  t = 1;
  if (slope(one, s, t) >= -kFlat * limit) return;
  // Neither alone suffices, so both are inflated. The cost is convex and smooth: Newton steps, halved until
  // the cost falls.
  const auto cost = [&](double slip, double tracker) {
    return (y.square() / (slip * l + tracker)).sum() + limit * (slip + tracker);
  };
  for (int i = 0; i < 100; ++i) {
    const Array total = s * l + t, curve = 2 * y.square() / total.cube();
    const double by_s = slope(l, s, t), by_t = slope(one, s, t);
    const double ss = (l.square() * curve).sum(), st = (l * curve).sum(), tt = curve.sum();
    const double determinant = ss * tt - st * st;
    if (!(determinant > 1e-14 * ss * tt)) return;
    const double step_s = (st * by_t - tt * by_s) / determinant,
                 step_t = (st * by_s - ss * by_t) / determinant;
    const double before = cost(s, t);
    double part = 1, next_s = s, next_t = t;
    for (int halving = 0; halving < 60; ++halving, part /= 2) {
      next_s = std::max(1.0, s + part * step_s);
      next_t = std::max(1.0, t + part * step_t);
      if (cost(next_s, next_t) <= before) break;
    }
    const double moved = std::abs(next_s - s) + std::abs(next_t - t);
    if (!(cost(next_s, next_t) <= before)) return;
    s = next_s;
    t = next_t;
    if (moved < 1e-9 * (s + t)) return;
  }
}

}  // namespace huber_detail

/// `slip` is P, which may be singular; `tracker` the diagonal of R. `limit` is a squared
/// number of standard deviations. `robust` says whose errors are down-weighted, at least the tracker's.
/// Cost  one inverse; an eigendecomposition in addition for outliers.
template <int N>
HuberLoss huber_loss(const Eigen::Matrix<double, N, 1>& r, const Eigen::Matrix<double, N, N>& slip,
                     const Eigen::Matrix<double, N, 1>& tracker, double limit, RobustMode robust) {
  using Square = Eigen::Matrix<double, N, N>;
  using Array = Eigen::Array<double, N, 1>;
  const Square total = slip + Square(tracker.asDiagonal());
  const Eigen::Matrix<double, N, 1> plain = total.inverse() * r;
  const bool slips = robust == RobustMode::tracker_and_wheels;
  if (plain.dot(tracker.cwiseProduct(plain)) <= limit && (!slips || plain.dot(slip * plain) <= limit))
    return {r.dot(plain), 1, 1};

  // In the coordinates in which both covariances are diagonal, in units of the tracker's error.
  const Eigen::Matrix<double, N, 1> unit = tracker.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Square> eigen(Square(unit.asDiagonal() * slip * unit.asDiagonal()));
  const Array l = eigen.eigenvalues().cwiseMax(0).array(), one = Array::Ones();
  const Array y = (eigen.eigenvectors().transpose() * unit.cwiseProduct(r)).array();
  HuberLoss loss;
  loss.tracker = huber_detail::inflation<Array>(y, one, l, limit);
  if (slips) huber_detail::inflate_both<Array>(y, l, limit, loss.slip, loss.tracker);
  loss.cost = (y.square() / (loss.slip * l + loss.tracker)).sum() + limit * (loss.slip - 1) +
              limit * (loss.tracker - 1);
  return loss;
}

}  // namespace astro::calibration
