#include "host/calibration/end_poses/robust_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/order_statistics.hpp"
#include "host/calibration/end_poses/compose.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"
#include "host/calibration/end_poses/end_scatter.hpp"
#include "host/calibration/end_poses/replay.hpp"
#include "host/calibration/end_poses/robust_weight.hpp"

namespace astro::calibration {
namespace {

using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;
using Jacobian = Eigen::Matrix<double, 3, 2>;

Vector3d vector_of(const EndPose& end) { return {end.x_m, end.y_m, end.theta_rad}; }

EndPose end_at(const Vector2d& p, Sense sense, const SquareSetup& setup) {
  return replay_square(setup.side_m, sense, setup.loaded,
                       compose(setup.loaded, std::exp(p(0)), std::exp(p(1))));
}

/// Where the squares of one direction end with ratios exp(p), and how that changes with p.
struct Expected {
  Vector3d end;
  Jacobian jacobian;

  Expected(const Vector2d& p, Sense sense, const SquareSetup& setup)
      : end(vector_of(end_at(p, sense, setup))) {
    constexpr double kStep = 1e-5;  // errors of 1e-11 by rounding and 1e-10 by curvature
    for (int column = 0; column < 2; ++column) {
      const Vector2d step = kStep * Vector2d::Unit(column);
      jacobian.col(column) =
          (vector_of(end_at(p + step, sense, setup)) - vector_of(end_at(p - step, sense, setup))) /
          (2 * kStep);
    }
  }
};

bool has_heading(const EndPose& end) { return !std::isnan(end.theta_rad); }

/// The inverse of the covariance of what was measured; zero for a heading that was not.
Matrix3d information_of(const Matrix3d& covariance, bool heading) {
  if (heading) return covariance.inverse();
  Matrix3d information = Matrix3d::Zero();
  information.topLeftCorner<2, 2>() = covariance.topLeftCorner<2, 2>().inverse();
  return information;
}

/// Measured minus expected; 0 for a heading that was not measured, to which the information is 0, too.
Vector3d residual_of(const EndPose& end, const Vector3d& expected) {
  Vector3d residual = vector_of(end) - expected;
  if (!has_heading(end)) residual.z() = 0;
  return residual;
}

/// The runs of one direction.
struct Direction {
  Sense sense;
  std::span<const EndPose> ends;
  Matrix3d whole, position;  // information about an end with heading, and without one

  Direction(Sense direction, std::span<const EndPose> runs, const SquareSetup& setup)
      : sense(direction), ends(runs) {
    const Matrix3d covariance = end_covariance(setup.side_m, sense, setup.loaded.b_m);
    whole = information_of(covariance, true);
    position = information_of(covariance, false);
  }
  const Matrix3d& information(const EndPose& end) const { return has_heading(end) ? whole : position; }
};

/// What an iteration adds up over the runs.
struct EndSums {
  Matrix2d curvature = Matrix2d::Zero();    // with the weights
  Matrix2d information = Matrix2d::Zero();  // without them
  Vector2d slope = Vector2d::Zero();
  std::vector<Distance> distances;

  void add(const Direction& direction, const Expected& expected, double scatter) {
    for (const EndPose& end : direction.ends) {
      const Matrix3d& known = direction.information(end);
      const Vector3d residual = residual_of(end, expected.end);
      distances.push_back({residual.dot(known * residual), has_heading(end) ? 3.0 : 2.0});
      const double weight = robust_weight(distances.back(), scatter);
      const Matrix2d about = expected.jacobian.transpose() * known * expected.jacobian;
      curvature += weight * about;
      information += about;
      slope += weight * expected.jacobian.transpose() * (known * residual);
    }
  }
};

/// Ratios from the medians of each direction, to first order. If the robot has driven in one direction only, its wheelbase is
/// taken as right.
Vector2d start_of(const Direction& cw, const Direction& ccw, const SquareSetup& setup) {
  const auto leg_rad = [&](const Direction& direction, double sign) -> std::optional<double> {
    std::vector<double> angles;
    for (const EndPose& end : direction.ends)
      angles.push_back((sign * end.x_m - end.y_m) / (4 * setup.side_m));
    if (angles.empty()) return std::nullopt;
    return median_of(std::move(angles));
  };
  const std::optional<double> sum = leg_rad(cw, -1), difference = leg_rad(ccw, 1);
  if (!sum && !difference) return Vector2d::Zero();
  const double beta = (sum.value_or(*difference) + difference.value_or(*sum)) / 2;
  const double alpha = sum.value_or(*difference) - beta;
  const double half = beta / setup.side_m * setup.loaded.b_m / 2;
  if (!(std::abs(alpha) < 0.5) || !(std::abs(half) < 0.25)) return Vector2d::Zero();
  return {std::log((1 + half) / (1 - half)), -std::log(1 - alpha * 2 / std::numbers::pi)};
}

/// The information of the prior.
Matrix2d information_of(const std::optional<RatioPrior>& prior) {
  if (!prior) return Matrix2d::Zero();
  return Vector2d(prior->E_d, prior->E_b).cwiseAbs2().cwiseInverse().asDiagonal();
}

/// A scatter below 1, that of usual robots, is raised, because a few runs do not prove it (surprise_of).
double cautious(double scatter) {
  constexpr double kUnsure = 2.5;
  return std::max(scatter, std::min(1.0, kUnsure * scatter));
}

[[noreturn]] void fail() {
  throw Error(
      "no pair of wheel and wheelbase ratios explains these ends of squares: check the units, the side "
      "length and that the clockwise and counter-clockwise runs are not exchanged",
      EndPoseProblem::no_ratios_fit);
}

}  // namespace

RobustFit fit_ends(std::span<const EndPose> cw_ends, std::span<const EndPose> ccw_ends,
                   const SquareSetup& setup, const std::optional<RatioPrior>& prior) {
  // Where two ends of a direction are far apart, the weights change slowly, and a step is only a twentieth shorter than the last.
  constexpr int kMostIterations = 2000, kScatterIterations = 30;
  constexpr double kSettled = 1e-12, kLongestStep = 0.3;
  const Direction cw(Sense::cw, cw_ends, setup), ccw(Sense::ccw, ccw_ends, setup);
  const Matrix2d known = information_of(prior);
  Vector2d p = start_of(cw, ccw, setup);
  double scatter = 1;
  for (int i = 0; i < kMostIterations; ++i) {
    EndSums sums;
    sums.add(cw, Expected(p, Sense::cw, setup), scatter);
    sums.add(ccw, Expected(p, Sense::ccw, setup), scatter);
    const Vector2d step = (sums.curvature / scatter + known).inverse() * (sums.slope / scatter - known * p);
    p += step * std::min(1.0, kLongestStep / step.norm());
    if (!p.allFinite() || p.norm() > 1) fail();
    const double fitted = prior ? 0 : 2;
    if (step.norm() < kSettled) {
      const double widened = kLossOfNormal * scatter_for_errors(sums.distances, scatter, fitted);
      return {std::exp(p(0)), std::exp(p(1)), (sums.information / widened + known).inverse(), scatter};
    }
    // The scatter is fixed after some steps, because a scatter that changes in each step could prevent
    // convergence.
    if (i < kScatterIterations) scatter = robust_scatter(sums.distances, fitted);
  }
  fail();
}

Surprise surprise_of(const EndPose& end, Sense sense, const RobustFit& fit, const SquareSetup& setup) {
  const Expected expected({std::log(fit.E_d), std::log(fit.E_b)}, sense, setup);
  const Matrix3d covariance = cautious(fit.scatter) * end_covariance(setup.side_m, sense, setup.loaded.b_m) +
                              expected.jacobian * fit.covariance * expected.jacobian.transpose();
  const Vector3d residual = residual_of(end, expected.end);
  return {{expected.end.x(), expected.end.y(), expected.end.z()},
          residual.dot(information_of(covariance, has_heading(end)) * residual)};
}

Ratios ratios_of(const RobustFit& fit, const SquareSetup& setup) {
  const WheelFactors truth = compose(setup.loaded, fit.E_d, fit.E_b);
  const double right = truth.c_r / setup.loaded.c_r, left = truth.c_l / setup.loaded.c_l;
  Ratios out{.E_d = fit.E_d, .E_b = fit.E_b};
  out.alpha_rad = std::numbers::pi / 2 * (1 - (right + left) / 2 / fit.E_b);
  out.beta_rad = setup.side_m * (right - left) / truth.b_m;
  out.curvature_per_m = (right - left) / truth.b_m / ((right + left) / 2);
  return out;
}

}  // namespace astro::calibration
