#include "host/simulation/study/summary.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "host/base/order_statistics.hpp"
#include "host/simulation/robot/normal_deviates.hpp"
#include "host/simulation/study/synthetic_drive.hpp"

namespace astro::simulation::study {
namespace {

using calibration::FactorCovariance;
using calibration::WheelFactors;

constexpr int kDraws = 20000;                           // leaves a Monte Carlo error of 1 %; some 50 ms
constexpr std::uint64_t kDrawSeed = 2'000'000'000'000;  // different from the seeds of the trials

/// Mean of some numbers and its standard error (NaN for one number).
template <class Read>
MeanError mean_of(std::size_t count, Read read) {
  const auto n = static_cast<double>(count);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < count; ++i) sum += read(i);
  const double mean = sum / n;
  for (std::size_t i = 0; i < count; ++i) squares += (read(i) - mean) * (read(i) - mean);
  return {mean, count > 1 ? std::sqrt(squares / (n - 1) / n) : std::nan("")};
}

std::vector<Errors> draws_from(const FactorCovariance& covariance, const TrialSetup& setup) {
  const Eigen::Matrix3d of_three = covariance.topLeftCorner<3, 3>();
  const Eigen::Matrix3d root = of_three.llt().matrixL();
  // An unknown e is uncertain together with E_d, because only both together give the curvature of a line.
  const Eigen::Vector3d between = covariance.topRightCorner<3, 1>();
  const Eigen::Vector3d with_three = of_three.llt().solve(between);
  const double alone = std::sqrt(std::max(0.0, covariance(3, 3) - with_three.dot(between)));
  const WheelFactors actual = setup.actual();
  std::mt19937_64 random(derived_seed(setup.seed, kDrawSeed));
  NormalDeviates normal;
  std::vector<Errors> errors;
  for (int i = 0; i < kDraws; ++i) {
    const double a = normal(random), b = normal(random), c = normal(random);
    const Eigen::Vector3d e = root * Eigen::Vector3d(a, b, c);
    const double curvature = with_three.dot(e) + (alone > 0 ? alone * normal(random) : 0);
    errors.push_back(
        errors_of({actual.c_r + e[0], actual.c_l + e[1], actual.b_m + e[2], actual.e + curvature}, setup));
  }
  return errors;
}

/// The errors of `method` in all trials in which it gave an answer.
std::vector<Errors> answers_of(std::size_t method, const std::vector<Trial>& trials) {
  std::vector<Errors> errors;
  for (const Trial& trial : trials)
    if (trial.errors[method]) errors.push_back(*trial.errors[method]);
  return errors;
}

std::string failure_of(std::size_t method, const std::vector<Trial>& trials) {
  const std::string name(kMethods[method]);
  int failed = 0;
  std::string example;
  for (const Trial& trial : trials) {
    if (trial.errors[method]) continue;
    ++failed;
    if (example.empty() && trial.failure.starts_with(name + ": "))
      example = ", as in trial " + std::to_string(trial.index) + ": " + trial.failure.substr(name.size() + 2);
  }
  if (failed == 0) return {};
  return name + " gave no answer in " + std::to_string(failed) + " of " + std::to_string(trials.size()) +
         " trials" + example;
}

std::optional<CovarianceConsistency> covariance_consistency(const std::vector<Trial>& trials) {
  std::vector<double> values;
  int unknowns = 0;
  for (const Trial& trial : trials) {
    if (!trial.ml_chi_square) continue;
    values.push_back(*trial.ml_chi_square);
    unknowns += trial.ml_unknowns;
  }
  if (values.empty()) return std::nullopt;
  const MeanError mean = mean_of(values.size(), [&](std::size_t i) { return values[i]; });
  // The theoretical standard error of a mean of chi-squares, because few trials often show too little
  // scatter.
  const auto count = static_cast<double>(values.size());
  const double expected = unknowns / count;
  return CovarianceConsistency{static_cast<int>(values.size()), mean.value, std::sqrt(2 * expected / count),
                               expected};
}

std::optional<double> median_K_m(const std::vector<Trial>& trials) {
  std::vector<double> values;
  for (const Trial& trial : trials)
    if (trial.ml_K_m) values.push_back(*trial.ml_K_m);
  if (values.empty()) return std::nullopt;
  return median_of(std::move(values));
}

/// Adds the errors of maximum likelihood in each factor: their ratio to the bound, and their mean.
void add_ml(const std::vector<Errors>& errors, Summary& summary) {
  const Row& row = summary.methods.back();
  for (const Figure figure : {kE_d, kB_over_S, kScale, kCurvature}) {
    if (figure == kCurvature && summary.setup.e == 0) continue;
    const double ratio = row.rms[figure] / summary.bound.rms[figure];
    summary.ml_over_bound.push_back({ratio, ratio / std::sqrt(2.0 * row.trials)});
    summary.ml_mean_errors.push_back(
        mean_of(errors.size(), [&](std::size_t i) { return errors[i][figure]; }));
  }
}

}  // namespace

Row row_of(const std::string& name, const std::vector<Errors>& errors) {
  Row row;
  row.name = name;
  row.trials = static_cast<int>(errors.size());
  for (std::size_t f = 0; f < kFigures; ++f) {
    const MeanError square =
        mean_of(errors.size(), [&](std::size_t i) { return errors[i][f] * errors[i][f]; });
    row.rms[f] = std::sqrt(square.value);
    row.se[f] = row.rms[f] > 0 ? square.se / (2 * row.rms[f]) : 0;
  }
  return row;
}

Row bound_of(const TrialSetup& setup, const DriveSource& source) {
  calibration::MlOptions options = setup.ml_options();
  options.noise = setup.noise;
  const WheelFactors actual = setup.actual();
  const FactorCovariance covariance =
      cramer_rao_bound(source.without_noise(setup), actual, calibration::LeverArm{}, options);
  Row row = row_of("Cramer-Rao bound", draws_from(covariance, setup));
  const calibration::MlErrors exact = errors_of(covariance, actual);
  row.rms[kE_d] = exact.E_d;
  row.rms[kB_over_S] = exact.b_over_scale_m / setup.wheelbase_m;
  row.rms[kScale] = exact.scale;
  row.rms[kCurvature] = exact.e;
  row.se[kE_d] = row.se[kB_over_S] = row.se[kScale] = row.se[kCurvature] = 0;
  return row;
}

Summary summarize(const TrialSetup& setup, const DriveSource& source, const std::vector<Trial>& trials) {
  source.check(setup);
  Summary summary;
  summary.setup = setup;
  summary.bound = bound_of(setup, source);
  for (std::size_t method = 0; method < kMethods.size(); ++method) {
    const std::vector<Errors> errors = answers_of(method, trials);
    if (!errors.empty()) summary.methods.push_back(row_of(std::string(kMethods[method]), errors));
    if (const std::string failure = failure_of(method, trials); !failure.empty())
      summary.failures.push_back(failure);
  }
  if (const std::vector<Errors> errors = answers_of(kMl, trials); !errors.empty()) add_ml(errors, summary);
  summary.ml_covariance = covariance_consistency(trials);
  summary.ml_median_K_m = median_K_m(trials);
  return summary;
}

}  // namespace astro::simulation::study
