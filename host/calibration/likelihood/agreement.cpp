#include "host/calibration/likelihood/agreement.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace astro::calibration {
namespace {

// If leaving the run out widens the covariance by less than this part in some direction, the run does not
// observe that direction.
constexpr double kSilent = 1e-4;

Disagreement disagreement(const Reduced& run, const Pool& all) {
  Pool without = all;
  without.take_out(run);
  const FactorMatrix before = all.factor_covariance();
  FactorMatrix gained = without.factor_covariance() - before;
  const FactorVector change = -(without.covariance(run.session) * run.gradient).head<kFactors>();
  // In units of the standard errors of all runs, so that ratios and metres are comparable. An e that is not estimated has none.
  const FactorVector unit =
      (before.diagonal().array() > 0).select(before.diagonal().cwiseSqrt().cwiseInverse(), 0);
  gained = unit.asDiagonal() * gained * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<FactorMatrix> eigen((gained + gained.transpose()) / 2);
  const FactorVector parts = eigen.eigenvectors().transpose() * unit.cwiseProduct(change);
  Disagreement found;
  for (int i = 0; i < kFactors; ++i) {
    const double variance = eigen.eigenvalues()[i];
    if (variance > 1e8) return {};
    if (variance < kSilent) continue;
    found.chi_square += parts[i] * parts[i] / variance;
    ++found.degrees_of_freedom;
  }
  return found;
}

}  // namespace

std::vector<Disagreement> disagreements(std::span<const Reduced> runs, const FixedParameters& fixed) {
  Pool all(fixed);
  for (const Reduced& run : runs) all.add(run);
  std::vector<Disagreement> found;
  for (const Reduced& run : runs) found.push_back(runs.size() > 1 ? disagreement(run, all) : Disagreement{});
  return found;
}

double dispersion(std::span<const Disagreement> runs) {
  constexpr double kSignificant = 0.01;
  double sum = 0;
  int freedom = 0, most = 0, compared = 0;
  for (const Disagreement& run : runs) {
    if (run.degrees_of_freedom == 0) continue;
    sum += run.chi_square;
    freedom += run.degrees_of_freedom;
    most = std::max(most, run.degrees_of_freedom);
    ++compared;
  }
  if (compared < 2) return 1;
  // Each run is compared with all others: n comparisons, of which n - 1 are independent.
  const double chi_square = sum * (compared - 1) / compared;
  const int independent = freedom - most;
  if (chi_square_tail(chi_square, independent) > kSignificant) return 1;
  return chi_square / independent;
}

double typical_dispersion(std::span<const Disagreement> runs) {
  constexpr double kMedian[] = {1, 0.4549, 1.3863, 2.3660,
                                3.3567};  // of chi-square by its degrees of freedom
  std::vector<double> ratios;
  for (const Disagreement& run : runs)
    if (run.degrees_of_freedom > 0)
      ratios.push_back(run.chi_square / kMedian[static_cast<std::size_t>(run.degrees_of_freedom)]);
  if (ratios.empty()) return 1;
  // The lower one of an even number, so that half of the runs cannot make the other half look usual.
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>((ratios.size() - 1) / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return std::max(1.0, *middle);
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
