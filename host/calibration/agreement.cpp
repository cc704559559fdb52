#include "host/calibration/agreement.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace astro::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A direction in which leaving the run out widens the covariance by less than this part is one it says
// nothing about.
constexpr double kSilent = 1e-4;

Disagreement disagreement(const Reduced& run, const SharedInformation& total, const Held& held) {
  const SharedInformation all = shared_covariance(total, held);
  const SharedInformation without = shared_covariance(total - run.information, held);
  const Matrix3d before = all.topLeftCorner<3, 3>();
  Matrix3d gained = (without - all).topLeftCorner<3, 3>();
  const Vector3d change = -(without * run.gradient).head<3>();
  // In units of the standard errors of all runs, so that ratios and metres compare.
  const Vector3d unit = before.diagonal().cwiseSqrt().cwiseInverse();
  gained = unit.asDiagonal() * gained * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen((gained + gained.transpose()) / 2);
  const Vector3d parts = eigen.eigenvectors().transpose() * unit.cwiseProduct(change);
  Disagreement found;
  for (int i = 0; i < 3; ++i) {
    const double variance = eigen.eigenvalues()[i];
    if (variance > 1e8) return {};
    if (variance < kSilent) continue;
    found.chi_square += parts[i] * parts[i] / variance;
    ++found.degrees_of_freedom;
  }
  return found;
}

}  // namespace

std::vector<Disagreement> disagreements(std::span<const Reduced> runs, const Held& held) {
  SharedInformation total = SharedInformation::Zero();
  for (const Reduced& run : runs) total += run.information;
  std::vector<Disagreement> found;
  for (const Reduced& run : runs)
    found.push_back(runs.size() > 1 ? disagreement(run, total, held) : Disagreement{});
  return found;
}

double dispersion(std::span<const Disagreement> runs) {
  constexpr double kSignificant = 0.01;
  Disagreement all;
  for (const Disagreement& run : runs) {
    all.chi_square += run.chi_square;
    all.degrees_of_freedom += run.degrees_of_freedom;
  }
  if (chi_square_tail(all.chi_square, all.degrees_of_freedom) > kSignificant) return 1;
  return all.chi_square / all.degrees_of_freedom;
}

double chi_square_tail(double value, int degrees_of_freedom) {
  if (degrees_of_freedom > 3) {
    const double k = degrees_of_freedom, variance = 2 / (9 * k);
    return std::erfc((std::cbrt(value / k) - (1 - variance)) / std::sqrt(2 * variance)) / 2;
  }
  switch (degrees_of_freedom) {
    case 1:
      return std::erfc(std::sqrt(value / 2));
    case 2:
      return std::exp(-value / 2);
    case 3:
      return std::erfc(std::sqrt(value / 2)) + std::sqrt(2 * value / std::numbers::pi) * std::exp(-value / 2);
    default:
      return 1;
  }
}

}  // namespace astro::calibration
