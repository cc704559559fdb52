#include "host/calibration/likelihood/huber.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace astro::calibration {
namespace {

using Array = Eigen::Array3d;

/// The least x >= 1 for which sum of a y^2 / (x a + b)^2 is within `limit`; all a and b are at least 0.
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
void inflate_both(const Array& y, const Array& l, double limit, double& s, double& t) {
  const Array one = Array::Ones();
  // Derivatives of the cost by s and by t.
  const auto slope = [&](const Array& by, double slip, double tracker) {
    return limit - (by * (y / (slip * l + tracker)).square()).sum();
  };
  constexpr double kFlat = 1e-9;
  if (slope(l, s, t) >= -kFlat * limit) return;
  s = inflation(y, l, one, limit);
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

}  // namespace

HuberLoss huber_loss(const Eigen::Vector3d& r, const Eigen::Matrix3d& slip, const Eigen::Vector3d& tracker,
                     double limit, RobustMode robust) {
  const Eigen::Matrix3d total = slip + Eigen::Matrix3d(tracker.asDiagonal());
  const Eigen::Vector3d plain = total.inverse() * r;
  const bool slips = robust == RobustMode::tracker_and_wheels;
  if (plain.dot(tracker.cwiseProduct(plain)) <= limit && (!slips || plain.dot(slip * plain) <= limit))
    return {r.dot(plain), 1, 1};

  // In the coordinates in which both covariances are diagonal, in units of the tracker's error.
  const Eigen::Vector3d unit = tracker.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
      Eigen::Matrix3d(unit.asDiagonal() * slip * unit.asDiagonal()));
  const Array l = eigen.eigenvalues().cwiseMax(0).array(), one = Array::Ones();
  const Array y = (eigen.eigenvectors().transpose() * unit.cwiseProduct(r)).array();
  HuberLoss loss;
  loss.tracker = inflation(y, one, l, limit);
  if (slips) inflate_both(y, l, limit, loss.slip, loss.tracker);
  loss.cost = (y.square() / (loss.slip * l + loss.tracker)).sum() + limit * (loss.slip - 1) +
              limit * (loss.tracker - 1);
  return loss;
}

}  // namespace astro::calibration
