#include "host/calibration/judgement/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/ml_fit.hpp"
#include "host/calibration/preparation/preparation.hpp"

namespace astro::calibration {
namespace {

constexpr std::size_t kMostGroups = 10;
constexpr int kPriorRuns = 4;

/// One-sided 10 % quantile of Student's t for at least kPriorRuns degrees of freedom.
double student_t_90(int degrees_of_freedom) {
  // Cornish-Fisher expansion about the normal quantile, good to 0.003 from four degrees of freedom on.
  const double z = 1.281552, n = degrees_of_freedom;
  const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
  return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

/// Every so many-th run, so that a group has runs of all kinds and senses if they were driven by turns or one after
/// the other.
std::vector<std::size_t> group(std::size_t index, std::size_t groups, std::size_t runs) {
  std::vector<std::size_t> members;
  for (std::size_t i = index; i < runs; i += groups) members.push_back(i);
  return members;
}

struct Split {
  std::vector<Trajectory> held_out, others;
};

Split split(std::span<const Trajectory> runs, const std::vector<std::size_t>& held_out) {
  Split out;
  for (std::size_t i = 0; i < runs.size(); ++i)
    (std::find(held_out.begin(), held_out.end(), i) == held_out.end() ? out.others : out.held_out)
        .push_back(runs[i]);
  return out;
}

/// Truth no closer than the estimate used it.
std::vector<Trajectory> thinned(std::span<const Trajectory> runs, double period_s) {
  std::vector<Trajectory> out(runs.begin(), runs.end());
  constexpr double kRounding_s = 1e-6;
  for (Trajectory& run : out) {
    double next_s = -std::numeric_limits<double>::infinity();
    std::erase_if(run.truth, [&](const BodySample& sample) {
      if (sample.time_s < next_s - kRounding_s) return true;
      next_s = sample.time_s + period_s;
      return false;
    });
  }
  return out;
}

/// How drives are followed with given factors; start poses, lever arm and clocks are fitted to the drives.
struct Followed {
  std::vector<RunErrors> errors;
  std::vector<double> cost;  // -2 log likelihood of each run
};

Followed followed(std::span<const Trajectory> runs, const WheelFactors& factors, const MlOptions& options) {
  const PreparedRuns prepared = prepare(runs, factors, options.clock_known, Density::independent);
  const MlFit fit(prepared, factors, options, true);
  Followed out{path_errors(fit, factors).runs, {}};
  for (const InnovationSums& sums : fit.sums()) out.cost.push_back(sums.cost);
  return out;
}

}  // namespace

int CrossValidation::better_on() const {
  return static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [](const HeldOutRun& run) { return run.gain > 0; }));
}

Verdict judge_gains(std::span<const double> gains) {
  const auto n = static_cast<double>(gains.size());
  if (gains.size() < 2) return Verdict::unknown;
  double mean = 0, squares = 0;
  for (const double gain : gains) mean += gain / n;
  for (const double gain : gains) squares += (gain - mean) * (gain - mean);
  const int freedom = static_cast<int>(gains.size()) - 1 + kPriorRuns;
  const double variance = (squares + kPriorRuns * 4 * std::abs(mean)) / freedom;
  const double t = mean / std::sqrt(variance / n);
  if (std::isnan(t)) return Verdict::unknown;
  if (std::abs(t) <= student_t_90(freedom)) return Verdict::undecided;
  return t > 0 ? Verdict::better : Verdict::worse;
}

CrossValidation cross_validate(std::span<const Trajectory> runs, const WheelFactors& in_use,
                               const MlEstimate& all, const MlOptions& options) {
  CrossValidation out;
  MlOptions with_noise = options;
  with_noise.noise = all.noise;
  const std::size_t groups = std::min(kMostGroups, runs.size());
  for (std::size_t i = 0; i < groups && runs.size() > 1; ++i) {
    const Split parts = split(runs, group(i, groups, runs.size()));
    try {
      const std::vector<Trajectory> others = thinned(parts.others, all.thinned_to_s);
      const std::vector<Trajectory> held_out = thinned(parts.held_out, all.thinned_to_s);
      const WheelFactors found = estimate_ml(others, in_use, with_noise).factors;
      // Which runs cannot be used does not depend on the factors, so both are of the same runs.
      const Followed by_in_use = followed(held_out, in_use, with_noise);
      const Followed by_found = followed(held_out, found, with_noise);
      for (std::size_t k = 0; k < by_found.errors.size(); ++k)
        out.runs.push_back({by_in_use.errors.at(k), by_found.errors[k],
                            (by_in_use.cost.at(k) - by_found.cost[k]) / all.dispersion});
    } catch (const Error& error) {
      out.not_judged.push_back(error.what());
    }
  }
  std::vector<double> gains;
  for (const HeldOutRun& run : out.runs) gains.push_back(run.gain);
  out.verdict = judge_gains(gains);
  return out;
}

}  // namespace astro::calibration
