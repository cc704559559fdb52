#pragma once

#include <Eigen/Core>

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

/// Whose errors Huber's loss down-weights where they are beyond the 99 % quantile.
enum class RobustMode { none, tracker, tracker_and_wheels };

struct HuberLoss {
  double cost = 0;
  double slip = 1, tracker = 1;  // s and t
};

/// `slip` is P, which may be singular; `tracker` the diagonal of R. `limit` is a squared
/// number of standard deviations. `robust` says whose errors are down-weighted, at least the tracker's.
/// Cost  one inverse; an eigendecomposition in addition for outliers.
HuberLoss huber_loss(const Eigen::Vector3d& r, const Eigen::Matrix3d& slip, const Eigen::Vector3d& tracker,
                     double limit, RobustMode robust);

}  // namespace astro::calibration
