#include "host/calibration/likelihood/agreement.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "host/base/order_statistics.hpp"

namespace astro::calibration {
namespace {

// If leaving the run out widens the covariance by less than this part in some direction, the run does not observe that
// direction. Between samples that are close to each other counts flicker, because they are whole numbers. On the lines of a
// square that looks like curves, so such a run seems to have information about e, some ten-thousandths of that of circles.
constexpr double kSilent = 1e-4, kSilentAmongFlicker = 1e-3;
constexpr double kSilentShare = 0.05;  // an upper limit, as a share of an average run's information

double silent_part(bool truth_is_spaced, std::size_t runs) {
  if (truth_is_spaced) return kSilent;
  return std::min(kSilentAmongFlicker, kSilentShare / static_cast<double>(runs));
}

Disagreement disagreement(const Reduced& run, const Pool& all, double silent) {
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
    if (variance < silent) continue;
    found.chi_square += parts[i] * parts[i] / variance;
    ++found.degrees_of_freedom;
  }
  return found;
}

/// Adds the information of another stretch of the same session.
void add(Reduced& sum, const Reduced& stretch) {
  sum.information += stretch.information;
  sum.gradient += stretch.gradient;
}

Reduced sum_of(std::span<const Reduced> stretches) {
  Reduced sum = stretches.front();
  for (const Reduced& stretch : stretches.subspan(1)) add(sum, stretch);
  return sum;
}

/// The runs that are no outliers, at the optimum of these alone, where their gradients cancel.
std::vector<RunInStretches> usual_ones(std::span<const RunInStretches> runs, const FixedParameters& fixed,
                                       const PriorOfE& prior) {
  std::vector<RunInStretches> usual;
  Pool pool(fixed, prior);
  for (const RunInStretches& run : runs) {
    if (run.outlier) continue;
    usual.push_back(run);
    for (const Reduced& stretch : run.stretches) pool.add(stretch);
  }
  for (RunInStretches& run : usual)
    for (Reduced& stretch : run.stretches)
      stretch.gradient -= stretch.information * pool.step(stretch.session);
  return usual;
}

/// The stretches at each place of each course, together.
std::vector<Reduced> by_place(std::span<const RunInStretches> runs) {
  std::map<int, std::vector<Reduced>> courses;
  for (const RunInStretches& run : runs) {
    const auto [course, is_new] = courses.try_emplace(run.course, run.stretches);
    for (std::size_t k = 0; k < run.stretches.size() && !is_new; ++k)
      add(course->second[k], run.stretches[k]);
  }
  std::vector<Reduced> places;
  for (const auto& [course, of_course] : courses)
    places.insert(places.end(), of_course.begin(), of_course.end());
  return places;
}

}  // namespace

std::vector<Disagreement> disagreements(std::span<const Reduced> runs, const FixedParameters& fixed,
                                        bool truth_is_spaced) {
  if (runs.size() < 2) return std::vector<Disagreement>(runs.size());
  Pool all(fixed);
  for (const Reduced& run : runs) all.add(run);
  const double silent = silent_part(truth_is_spaced, runs.size());
  std::vector<Disagreement> found;
  for (const Reduced& run : runs) found.push_back(disagreement(run, all, silent));
  return found;
}

double Scatter::ratio() const { return degrees_of_freedom > 0 ? chi_square / degrees_of_freedom : 1; }

bool Scatter::significant() const {
  constexpr double kSignificant = 0.01;
  return chi_square_tail(chi_square, degrees_of_freedom) <= kSignificant;
}

Scatter scatter(std::span<const Disagreement> runs) {
  double sum = 0;
  int freedom = 0, most = 0, compared = 0;
  for (const Disagreement& run : runs) {
    if (run.degrees_of_freedom == 0) continue;
    sum += run.chi_square;
    freedom += run.degrees_of_freedom;
    most = std::max(most, run.degrees_of_freedom);
    ++compared;
  }
  if (compared < 2) return {};
  return {sum * (compared - 1) / compared, freedom - most};
}

double dispersion(std::span<const Disagreement> runs) {
  const Scatter all = scatter(runs);
  return all.significant() ? all.ratio() : 1;
}

double clustered_dispersion(std::span<const RunInStretches> runs, const FixedParameters& fixed,
                            bool truth_is_spaced, const PriorOfE& prior) {
  const std::vector<RunInStretches> usual = usual_ones(runs, fixed, prior);
  if (usual.size() < 2) return 1;
  std::vector<Reduced> whole, single;
  for (const RunInStretches& run : usual) {
    whole.push_back(sum_of(run.stretches));
    single.insert(single.end(), run.stretches.begin(), run.stretches.end());
  }
  const auto scatter_of = [&](std::span<const Reduced> parts) {
    return scatter(disagreements(parts, fixed, truth_is_spaced));
  };
  const Scatter by_run = scatter_of(whole), at_places = scatter_of(by_place(usual));
  if (!truth_is_spaced && !by_run.significant() && !at_places.significant()) return 1;
  const Scatter alone = scatter_of(single);
  for (const Scatter& each : {by_run, at_places, alone})
    if (each.degrees_of_freedom == 0) return std::max(1.0, by_run.ratio());
  return std::max(1.0, by_run.ratio() + at_places.ratio() - alone.ratio());
}

double typical_dispersion(std::span<const Disagreement> runs) {
  constexpr double kMedian[] = {1, 0.4549, 1.3863, 2.3660,
                                3.3567};  // of chi-square by its degrees of freedom
  std::vector<double> ratios;
  for (const Disagreement& run : runs)
    if (run.degrees_of_freedom > 0)
      ratios.push_back(run.chi_square / kMedian[static_cast<std::size_t>(run.degrees_of_freedom)]);
  if (ratios.empty()) return 1;
  return std::max(1.0, lower_median_of(std::move(ratios)));
}

std::vector<bool> outliers(std::span<const Disagreement> runs) {
  constexpr double kUnlikely = 1e-3;
  const double typical = typical_dispersion(runs);
  std::vector<bool> outlier;
  for (const Disagreement& run : runs)
    outlier.push_back(chi_square_tail(run.chi_square / typical, run.degrees_of_freedom) *
                          static_cast<double>(runs.size()) <
                      kUnlikely);
  return outlier;
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
