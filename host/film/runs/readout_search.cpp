#include "host/film/runs/readout_search.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/experiment/analysis/trajectories.hpp"

namespace astro::film {
namespace {

constexpr double kMost_s = 0.04, kCoarse_s = 0.02, kFine_s = 0.005;

struct Trial {
  double readout_s, chi_square;
};

/// The minimum of the parabola through three trials, and the distance at which it is higher by 1.
std::optional<Readout> vertex(const Trial& a, const Trial& b, const Trial& c) {
  const double ab = (b.chi_square - a.chi_square) / (b.readout_s - a.readout_s);
  const double bc = (c.chi_square - b.chi_square) / (c.readout_s - b.readout_s);
  const double curve = (bc - ab) / (c.readout_s - a.readout_s);
  if (!(curve > 0)) return std::nullopt;
  return Readout{(a.readout_s + b.readout_s) / 2 - ab / (2 * curve), 1 / std::sqrt(curve)};
}

}  // namespace

std::optional<Readout> find_readout(const std::function<experiment::RunSet(double)>& with, double usual_s) {
  calibration::MlOptions options;
  calibration::WheelFactors loaded;
  const auto estimated = [&](double readout_s) {
    const experiment::RunSet set = with(readout_s);
    loaded = experiment::loaded_factors(set.runs.front().info);
    return calibration::estimate_ml(experiment::trajectories_of(set), loaded, options);
  };
  const calibration::MlEstimate start = estimated(usual_s);
  // All trials use the same noise, so that differences in chi-square are those in likelihood.
  options.noise = start.noise;
  options.spacing_m = start.spacing_m;
  options.widening = start.widening;
  const int freedom = std::max(1, start.degrees_of_freedom);
  const auto tried = [&](double readout_s) {
    const calibration::MlEstimate found = estimated(readout_s);
    return Trial{readout_s, found.chi_square / std::max(1, found.degrees_of_freedom) * freedom};
  };
  std::vector<Trial> trials;
  for (double readout_s = -kMost_s; readout_s < kMost_s + kCoarse_s / 2; readout_s += kCoarse_s)
    trials.push_back(tried(readout_s));
  const auto lowest = std::min_element(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
    return a.chi_square < b.chi_square;
  });
  const auto middle = std::clamp(lowest, trials.begin() + 1, trials.end() - 2);
  const auto rough = vertex(*(middle - 1), *middle, *(middle + 1));
  if (!rough) return std::nullopt;
  const double near_s = std::clamp(rough->seconds, -kMost_s, kMost_s);
  const auto fine = vertex(tried(near_s - kFine_s), tried(near_s), tried(near_s + kFine_s));
  Readout found = fine && std::abs(fine->seconds - near_s) < 2 * kFine_s ? *fine : *rough;
  found.seconds = std::clamp(found.seconds, -kMost_s, kMost_s);
  // The noise was estimated at the usual readout time, so it may be too large at the best one. The chi-square
  // there scales the standard error.
  found.sigma_s = rough->sigma_s * std::sqrt(std::min(1.0, lowest->chi_square / freedom));
  constexpr double kUseless_s = 0.015;
  if (!(found.sigma_s < kUseless_s)) return std::nullopt;
  return found;
}

}  // namespace astro::film
