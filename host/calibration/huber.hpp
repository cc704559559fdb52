#pragma once

#include <Eigen/Dense>
#include <cmath>

/// Huber's loss for a truth sample after wheels that slip.
///
/// An innovation r = slip + tracker's error has two causes, of covariances P and R, and only the tracker is
/// suspected of bad moments. So the loss is that of the likelier division of r,
///
///   min over e of  rho(e' R^-1 e) + (r - e)' P^-1 (r - e),   rho(q) = q up to limit, then
///                                                            2 sqrt(limit q) - limit.
///
/// Its slope is 2 (P + t R)^-1 r: exactly what a filter gives a sample whose R it takes t times as large.
/// Where the tracker's error outweighs slip t is Huber's sqrt(q / limit); where slip outweighs it, after a
/// gap, t is 1, and the cost is as honest about that as the weight.
/// Source  Huber 1964, Ann. Math. Stat. 35(1), for the loss; Masreliez & Martin 1977 for such a filter.
namespace astro::calibration {

struct HuberLoss {
  double cost = 0;
  double inflation = 1;  // t, of the tracker's covariance
};

/// `slip` is P, which may be singular; `tracker` the diagonal of R. `limit` is a square, in standard
/// deviations of the tracker. Cost  that of the inverse; for bad samples an eigendecomposition more.
template <int N>
HuberLoss huber_loss(const Eigen::Matrix<double, N, 1>& r, const Eigen::Matrix<double, N, N>& slip,
                     const Eigen::Matrix<double, N, 1>& tracker, double limit) {
  using Square = Eigen::Matrix<double, N, N>;
  const Square total = slip + Square(tracker.asDiagonal());
  const Eigen::Matrix<double, N, 1> plain = total.inverse() * r;
  if (plain.dot(tracker.cwiseProduct(plain)) <= limit) return {r.dot(plain), 1};

  // In units of the tracker, where t solves sum of (y / (l + t))^2 = limit: convex, so Newton from the left.
  const Eigen::Matrix<double, N, 1> unit = tracker.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Square> eigen(Square(unit.asDiagonal() * slip * unit.asDiagonal()));
  const auto l = eigen.eigenvalues().cwiseMax(0).array().eval();
  const auto y = (eigen.eigenvectors().transpose() * unit.cwiseProduct(r)).array().eval();
  double t = 1;
  for (int i = 0; i < 100; ++i) {
    const double excess = (y / (l + t)).square().sum() - limit;
    if (excess <= 1e-12 * limit) break;
    t += excess / (2 * (y.square() / (l + t).cube()).sum());
  }
  return {limit * (2 * t - 1) + (l * (y / (l + t)).square()).sum(), t};
}

}  // namespace astro::calibration
