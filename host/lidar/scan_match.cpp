#include "host/lidar/scan_match.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "host/base/order_statistics.hpp"

namespace astro::lidar {
namespace {

constexpr int kMostSteps = 35, kFewestSteps = 12;
constexpr double kFirstGate_m = 0.6, kLastGate_m = 0.12, kShrinks = 0.85;
constexpr std::size_t kFewestPairs = 25;
constexpr double kLeastSigma_m = 0.015;
/// The lines' own errors are shared by neighbouring points, so the errors are larger than those of independent points.
constexpr double kShared = 4;
/// Part of the normals' squares along a direction. Noise alone makes normals of one wall differ by about 0.1.
constexpr double kWeakNormals = 0.03;
constexpr double kUnknown_m = 10, kDegenerate_m = 1;

/// A point on a line: the row of the Jacobian, and the distance.
struct Pair {
  Eigen::Vector3d jacobian;
  double residual_m;
};

std::vector<Pair> pairs_of(const NearestPoints& reference, std::span<const SurfacePoint> scan,
                           const Pose2& motion, double gate_m) {
  std::vector<Pair> pairs;
  pairs.reserve(scan.size());
  const double c = std::cos(motion.theta_rad), s = std::sin(motion.theta_rad);
  for (const SurfacePoint& point : scan) {
    const Point2 arm{c * point.at.x_m - s * point.at.y_m, s * point.at.x_m + c * point.at.y_m};
    const Point2 at{motion.x_m + arm.x_m, motion.y_m + arm.y_m};
    const SurfacePoint* const line = reference.nearest(at, gate_m);
    if (line == nullptr || !line->on_line) continue;
    const Point2& n = line->normal;
    pairs.push_back({{n.x_m, n.y_m, n.y_m * arm.x_m - n.x_m * arm.y_m},
                     (at.x_m - line->at.x_m) * n.x_m + (at.y_m - line->at.y_m) * n.y_m});
  }
  return pairs;
}

struct Normal {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double weight = 0, sigma_m = 0;
};

Normal normal_equations(const std::vector<Pair>& pairs) {
  std::vector<double> residuals;
  residuals.reserve(pairs.size());
  for (const Pair& pair : pairs) residuals.push_back(pair.residual_m);
  Normal sum;
  sum.sigma_m = std::max(kLeastSigma_m, deviation_of(std::move(residuals)));
  for (const Pair& pair : pairs) {
    const double ratio = pair.residual_m / (2 * sum.sigma_m), weight = 1 / (1 + ratio * ratio);
    sum.information.noalias() += weight * pair.jacobian * pair.jacobian.transpose();
    sum.gradient += weight * pair.residual_m * pair.jacobian;
    sum.weight += weight;
  }
  return sum;
}

/// The direction in which the walls show a translation least, whatever the heading; and whether what they show of it is no more
/// than the noise of the normals.
struct Weakest {
  Eigen::Vector3d direction;
  bool noise;
};

Weakest weakest_of(const Normal& normal) {
  const Eigen::Matrix3d& all = normal.information;
  const Eigen::Vector2d mixed = all.block<2, 1>(0, 2);
  const Eigen::Matrix2d translation =
      all.topLeftCorner<2, 2>() - mixed * mixed.transpose() / std::max(all(2, 2), 1e-9);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(translation);
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  direction.head<2>() = axes.eigenvectors().col(0);
  return {direction, axes.eigenvalues()(0) < kWeakNormals * normal.weight};
}

/// What is known along `direction` is taken away, so that a step leaves the motion along it as it is.
void forget(const Eigen::Vector3d& direction, Normal& normal) {
  const Eigen::Matrix3d others = Eigen::Matrix3d::Identity() - direction * direction.transpose();
  normal.information = others * normal.information * others;
  normal.gradient = others * normal.gradient;
}

Eigen::Matrix3d covariance_of(const Normal& normal) {
  const double variance = normal.sigma_m * normal.sigma_m * kShared;
  // So little information that it only stands for what is not known at all.
  const Eigen::Matrix3d least = variance / (kUnknown_m * kUnknown_m) * Eigen::Matrix3d::Identity();
  return (normal.information + least).inverse() * variance;
}

}  // namespace

bool ScanMatch::degenerate() const { return weakest_m > kDegenerate_m; }

std::optional<ScanMatch> match(const NearestPoints& reference, std::span<const SurfacePoint> scan,
                               const Pose2& start) {
  ScanMatch found;
  found.motion = start;
  double gate_m = kFirstGate_m;
  Normal normal;
  for (int step = 0; step < kMostSteps; ++step, gate_m = std::max(kLastGate_m, gate_m * kShrinks)) {
    const std::vector<Pair> pairs = pairs_of(reference, scan, found.motion, gate_m);
    if (pairs.size() < kFewestPairs) return {};
    found.overlap = static_cast<double>(pairs.size()) / static_cast<double>(scan.size());
    normal = normal_equations(pairs);
    if (const Weakest weakest = weakest_of(normal); weakest.noise) forget(weakest.direction, normal);
    const Eigen::Vector3d change =
        -(normal.information + 1e-6 * Eigen::Matrix3d::Identity()).ldlt().solve(normal.gradient);
    found.motion = {found.motion.x_m + change(0), found.motion.y_m + change(1),
                    found.motion.theta_rad + change(2)};
    if (step > kFewestSteps && change.cwiseAbs().maxCoeff() < 2e-5) break;
  }
  found.sigma_m = normal.sigma_m;
  found.covariance = covariance_of(normal);
  found.weakest_m = std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(Eigen::Matrix2d(found.covariance.topLeftCorner<2, 2>()))
          .eigenvalues()(1));
  return found;
}

}  // namespace astro::lidar
