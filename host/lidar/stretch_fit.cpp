#include "host/lidar/stretch_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "host/base/order_statistics.hpp"
#include "host/calibration/motion/spread_of_e.hpp"

namespace astro::lidar {
namespace {

Eigen::Vector3d vector_of(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.theta_rad}; }

/// What wheels do that no factors explain, on a stretch: standard deviations of x, y and theta.
Eigen::Matrix3d scatter_of(std::span<const LinearStretch> stretches) {
  const Eigen::Vector3d least{0.01, 0.01, 0.003};
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> residuals;
    for (const LinearStretch& one : stretches) residuals.push_back(one.residual(axis));
    const double middle = median_of(residuals);
    for (double& residual : residuals) residual -= middle;
    const double deviation = std::max(deviation_of(std::move(residuals)), least(axis));
    scatter(axis, axis) = deviation * deviation;
  }
  return scatter;
}

/// Residual of a stretch at other unknowns than those at which it was linearised.
Eigen::Vector3d residual_at(const LinearStretch& one, const Unknowns& change) {
  return one.residual - one.jacobian * change;
}

/// By how much larger the residuals of some axes are than expected. A match that does not show all of them does not count: what it
/// does not show is as the wheels say.
double spread_of(std::span<const LinearStretch> stretches, const std::vector<Eigen::Matrix3d>& expected,
                 const Unknowns& change, std::initializer_list<int> axes) {
  constexpr double kLeast = 1e-3, kUnknown = 0.25;  // m^2
  std::vector<double> ratios;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Eigen::Vector3d residual = residual_at(stretches[i], change), variances = expected[i].diagonal();
    const bool shown =
        std::all_of(axes.begin(), axes.end(), [&](int axis) { return variances(axis) < kUnknown; });
    if (!shown) continue;
    for (const int axis : axes) ratios.push_back(residual(axis) / std::sqrt(variances(axis)));
  }
  return ratios.empty() ? 1 : std::max(deviation_of(std::move(ratios)), kLeast);
}

/// Of lengths and of headings: matches may be better or worse than they say, and wheels scatter more in the heading. x and y are
/// alike, so that a direction that a match does not show stays the same.
Eigen::Vector3d spreads_of(std::span<const LinearStretch> stretches,
                           const std::vector<Eigen::Matrix3d>& expected, const Unknowns& change) {
  const double length = spread_of(stretches, expected, change, {0, 1});
  return {length, length, spread_of(stretches, expected, change, {2})};
}

/// Adds what one stretch says. Cauchy's weight: what lies far off counts little.
void add(const LinearStretch& one, const Eigen::Vector3d& residual, const Eigen::Matrix3d& inverse,
         Information& information, Unknowns& gradient) {
  constexpr double kCauchy = 7;
  const Eigen::Matrix3d weight = inverse / (1 + residual.dot(inverse * residual) / kCauchy);
  information.noalias() += one.jacobian.transpose() * weight * one.jacobian;
  gradient.noalias() += one.jacobian.transpose() * (weight * residual);
}

/// Leaves the unknowns at their means that have no deviation.
void hold(const Unknowns& deviation, Information& information, Unknowns& gradient) {
  for (int k = 0; k < kUnknowns; ++k) {
    if (deviation(k) > 0) continue;
    information.row(k).setZero();
    information.col(k).setZero();
    information(k, k) = 1;
    gradient(k) = 0;
  }
}

}  // namespace

Prior wide_prior(const Unknowns& start, bool late) {
  Prior prior{start, {}};
  prior.mean(kArcs) = 0;
  prior.deviation << 0.02, 0.05, 0.02, calibration::kSpreadOfE, 0.3, 0.15, 0.2, late ? 0.1 : 0;
  return prior;
}

std::vector<LinearStretch> linearised(std::span<const Stretch> stretches, const Unknowns& at,
                                      const calibration::WheelFactors& loaded) {
  constexpr double kStep = 1e-5;
  std::vector<LinearStretch> all;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch& stretch = stretches[i];
    if (!stretch.scanner) continue;
    LinearStretch one;
    one.index = i;
    one.covariance = stretch.scanner->covariance;
    one.residual = vector_of(difference(stretch.scanner->motion, predicted(stretch, at, loaded)));
    for (int k = 0; k < kUnknowns; ++k) {
      Unknowns more = at, less = at;
      more(k) += kStep;
      less(k) -= kStep;
      one.jacobian.col(k) =
          vector_of(difference(predicted(stretch, more, loaded), predicted(stretch, less, loaded))) /
          (2 * kStep);
    }
    all.push_back(one);
  }
  return all;
}

StretchFit fit(std::span<const LinearStretch> stretches, const Unknowns& at, const Prior& prior) {
  constexpr int kSteps = 15;
  const Eigen::Matrix3d scatter = scatter_of(stretches);
  std::vector<Eigen::Matrix3d> expected;
  for (const LinearStretch& one : stretches) expected.push_back(one.covariance + scatter);
  const Unknowns prior_weight =
      (prior.deviation.array() > 0).select(prior.deviation.cwiseAbs2().cwiseInverse(), 0);
  StretchFit found{prior.mean, Information::Zero()};
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::DiagonalMatrix<double, 3> by =
        spreads_of(stretches, expected, found.unknowns - at).cwiseInverse().asDiagonal();
    Information information = prior_weight.asDiagonal();
    Unknowns gradient = prior_weight.cwiseProduct(prior.mean - found.unknowns);
    for (std::size_t i = 0; i < stretches.size(); ++i)
      add(stretches[i], residual_at(stretches[i], found.unknowns - at), by * expected[i].inverse() * by,
          information, gradient);
    hold(prior.deviation, information, gradient);
    found.covariance = information.inverse();
    const Unknowns change = found.covariance * gradient;
    found.unknowns += change;
    if (change.cwiseAbs().maxCoeff() < 1e-9) break;
  }
  for (int k = 0; k < kUnknowns; ++k)
    if (!(prior.deviation(k) > 0)) found.covariance(k, k) = 0;
  return found;
}

IteratedFit iterated_fit(std::span<const Stretch> stretches, const Prior& prior,
                         const calibration::WheelFactors& loaded) {
  constexpr int kMostTimes = 6;
  IteratedFit all;
  all.fit.unknowns = prior.mean;
  for (int time = 0; time < kMostTimes; ++time) {
    // Only here, so that it is where the stretches were linearised even if the last pass changes the unknowns.
    all.at = all.fit.unknowns;
    all.stretches = linearised(stretches, all.at, loaded);
    all.fit = fit(all.stretches, all.at, prior);
    if ((all.fit.unknowns - all.at).cwiseAbs().maxCoeff() < 1e-5) break;
  }
  return all;
}

}  // namespace astro::lidar
