#include "host/calibration/likelihood/ml_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/start_values.hpp"
#include "host/calibration/likelihood/whiteness.hpp"

namespace astro::calibration {
namespace {

constexpr int kMostSteps = 30, kMostRounds = 6, kMostScorings = 20;
// If the cost falls by less, the parameters move by less than a twentieth of their standard errors.
constexpr double kSettled = 1e-3;
constexpr double kNoiseSettled = 0.01;  // of the logarithms of the variances
constexpr double kLargestNoiseStep = 2;
constexpr double kLargestK_m = 1e-2;
constexpr int kFewestSamples = 20;  // of a run
constexpr int kMostPhases = 4;
// e is estimated if it is so many standard errors from zero, if these are small, and if tyres can explain it: wheels out of round
// would ask for an e of 2 or 3 to bend what should be lines.
constexpr double kShown = 2, kUncertainE = 0.02, kLargestE = 0.2;
// Once the innovations are not independent, closer samples than these are not tried: what a spin winds up and the next line
// lets go of must lie between two samples more often than not, and a quarter turn is 0.8 wheelbases of the wheels' way. No simple
// multiple of that, or the samples would fall upon the same place of every corner.
constexpr double kLeastSpacing = 1.25;  // wheelbases

/// Changes the logarithm of a variance, which is stored as its `power`-th root, within limits. Returns the size
/// of the actual change.
double scale_variance(double& value, int power, double change, double least, double most) {
  const double step = std::clamp(change, -kLargestNoiseStep, kLargestNoiseStep);
  const double before = value;
  value = std::clamp(before * std::exp(step / power), least, most);
  return std::abs(power * std::log(value / before));
}

}  // namespace

MlFit::MlFit(const PreparedRuns& prepared, const WheelFactors& loaded, const MlOptions& options, Held held,
             std::span<const Unknowns> start)
    : runs_(prepared.runs),
      loaded_(loaded),
      unknowns_(start.empty() ? start_values(prepared, loaded)
                              : std::vector<Unknowns>(start.begin(), start.end())),
      least_noise_(options.noise ? *options.noise : start_noise(prepared)) {
  fixed_.factors = held != Held::nothing;
  fixed_.session = held == Held::factors_and_sessions;
  fixed_.e = fixed_.factors || !options.with_e.value_or(false);
  fixed_.clock = options.clock_known;
  fixed_.lever_yaw =
      std::none_of(runs_.begin(), runs_.end(), [](const PreparedRun& run) { return run.has_headings; });
  for (Unknowns& u : unknowns_) {
    if (fixed_.clock) u[kSkew] = u[kClockOffset] = 0;
    if (fixed_.factors)
      u.head<kFactors>() << loaded.c_r, loaded.c_l, loaded.b_m, loaded.e;
    else if (fixed_.e)
      u[kE] = 0;
  }
  moves_ = moves_of(unknowns_);
  fit(options, !start.empty());
  if (!fixed_.factors && !options.with_e)
    fit_e(options);
  else if (!fixed_.e)
    e_ = e_to_first_order();
}

void MlFit::fit(const MlOptions& options, bool started) {
  robust_ = RobustMode::none;
  noise_ = least_noise_;
  spacing_m_ = 0;
  phases_ = 1;
  // The first fit is least squares, because a sample that looks like an outlier to a first guess may be right.
  if (!started || !options.robust || !options.noise) maximise();
  require_plausible();
  if (options.robust) robust_ = RobustMode::tracker_and_wheels;
  if (options.noise) {
    spacing_m_ = options.spacing_m;
    phases_ = spacing_m_ > 0 ? kMostPhases : 1;
    if (options.robust || spacing_m_ > 0) maximise();
  } else {
    fit_with_noise();
    find_spacing();
    widen_uncertain_slip();
  }
  require_plausible();
}

/// The wheelbase is one number until the runs show that it is not: an e that is only noise would widen the errors of b and
/// gain nothing.
void MlFit::fit_e(const MlOptions& options) {
  const auto shown = [&] {
    return std::abs(e_.value) > kShown * e_.standard_error && e_.standard_error < kUncertainE &&
           std::abs(e_.value) < kLargestE;
  };
  fixed_.e = false;
  e_ = e_to_first_order();
  if (shown()) {
    auto without = std::tuple(unknowns_, moves_, noise_, spacing_m_, phases_, sums_);
    fit(options, true);
    e_ = e_to_first_order();
    if (shown()) return;
    std::tie(unknowns_, moves_, noise_, spacing_m_, phases_, sums_) = std::move(without);
    e_ = e_to_first_order();
  }
  fixed_.e = true;
}

OneUnknown MlFit::e_to_first_order() const {
  const double now = unknowns_.front()[kE];
  const Pool pool = pool_of(sums_, fixed_, now);
  return {now + pool.factor_step()[kE], std::sqrt(pool.factor_covariance()(kE, kE))};
}

std::vector<Moves> MlFit::moves_of(std::span<const Unknowns> unknowns) const {
  std::vector<Moves> moves;
  moves.reserve(runs_.size());
  for (std::size_t i = 0; i < runs_.size(); ++i)
    moves.emplace_back(runs_[i], unknowns[i], fixed_.factors ? loaded_.kappa0 : kUsualKappa0);
  return moves;
}

double MlFit::cost_of(std::span<const InnovationSums> sums, double e) const {
  double cost = fixed_.e ? 0 : prior_cost(e);
  for (const InnovationSums& run : sums) cost += run.cost;
  return cost;
}

void MlFit::fit_with_noise() {
  for (int round = 0; round < kMostRounds; ++round) {
    const bool settled = fit_noise();
    maximise();
    if (settled) break;
  }
}

/// Doubles the spacing of the samples until the innovations are independent.
void MlFit::find_spacing() {
  while (!innovations_are_independent()) {
    spacing_m_ = std::max(2 * spacing_m_, kLeastSpacing * loaded_.b_m);
    fit_with_noise();
  }
  if (spacing_m_ == 0) return;
  phases_ = kMostPhases;
  fit_with_noise();
}

bool MlFit::innovations_are_independent() const {
  const int fitted = kShared + kOwn * static_cast<int>(runs_.size());
  std::vector<std::vector<Eigen::Vector3d>> by_run;
  for (const Moves& run : moves_)
    by_run.push_back(standardised_innovations(run, noise_, robust_, samples_of(run.run(), 0)));
  if (!are_independent(by_run, fitted)) return false;
  std::vector<std::vector<Eigen::Vector3d>> spacings(1);
  for (const auto& run : by_run) spacings[0].insert(spacings[0].end(), run.begin(), run.end());
  // What comes and goes within a few samples shows in the sums over neighbours.
  for (double spacing_m = std::max(2 * spacing_m_, kLeastSpacing / 2 * loaded_.b_m);; spacing_m *= 2) {
    std::vector<Eigen::Vector3d>& wider = spacings.emplace_back();
    for (const Moves& run : moves_) {
      const auto of_run = standardised_innovations(run, noise_, robust_, {spacing_m, 0});
      wider.insert(wider.end(), of_run.begin(), of_run.end());
    }
    if (wider.size() < fewest_innovations(fitted)) break;
  }
  return hold_over_path(spacings, fitted);
}

std::vector<InnovationSums> MlFit::pass(std::span<const Moves> moves, RobustMode robust) const {
  std::vector<InnovationSums> sums;
  for (const Moves& run : moves) {
    std::vector<InnovationSums> passes;
    for (int phase = 0; phase < phases_; ++phase)
      passes.push_back(innovations(run, noise_, robust, samples_of(run.run(), phase)));
    sums.push_back(mean_of(passes));
  }
  return sums;
}

std::vector<InnovationSums> MlFit::sums_with_full_slip_weight() const {
  return pass(moves_, std::min(robust_, RobustMode::tracker));
}

NoiseSlope MlFit::noise_slopes() const {
  NoiseSlope sum;
  for (const Moves& run : moves_)
    for (int phase = 0; phase < phases_; ++phase) {
      const NoiseSlope part = noise_slope(run, noise_, robust_, samples_of(run.run(), phase));
      sum.gradient += part.gradient / phases_;
      sum.curvature += part.curvature / phases_;
    }
  // Without headings nothing determines their noise. This keeps it where it is.
  sum.curvature.diagonal().array() += 1e-9;
  return sum;
}

/// Thinned truth begins at several samples (phases), so that the result does not depend on one of them. Their
/// likelihoods are averaged, not added, because all of them contain the same slip. A short run is thinned
/// less.
SampleSelection MlFit::samples_of(const PreparedRun& run, int phase) const {
  const double spacing_m = std::min(spacing_m_, run.path_m.back() / kFewestSamples);
  return {spacing_m, phase * spacing_m / phases_};
}

void MlFit::maximise() {
  double damping = 0;
  sums_ = pass(moves_, robust_);
  for (int step = 0; step < kMostSteps; ++step) {
    ++iterations_;
    const std::vector<Unknowns> steps = gauss_newton_step(sums_, fixed_, damping, unknowns_.front()[kE]);
    double expected = 0;
    std::vector<Unknowns> next = unknowns_;
    for (std::size_t i = 0; i < next.size(); ++i) {
      next[i] += steps[i];
      expected += steps[i].dot(sums_[i].gradient);
    }
    std::vector<Moves> moves = moves_of(next);
    std::vector<InnovationSums> sums = pass(moves, robust_);
    const double fall = cost_of(sums_, unknowns_.front()[kE]) - cost_of(sums, next.front()[kE]);
    if (fall > -kSettled) {
      unknowns_ = std::move(next);
      moves_ = std::move(moves);
      sums_ = std::move(sums);
      damping = damping < 1e-3 ? 0 : damping / 10;
    } else {
      damping = std::max(10 * damping, 1e-3);
      if (damping > 1e6) return;
    }
    // A damped step is small because of the damping, so it does not show convergence.
    if (damping == 0 && (expected < kSettled || std::abs(fall) < kSettled)) return;
  }
}

/// Fisher's scoring in the logarithms of the variances; true if they hardly changed.
bool MlFit::fit_noise() {
  double first = 0;
  for (int step = 0; step < kMostScorings; ++step) {
    const NoiseSlope slope = noise_slopes();
    const Eigen::Vector3d change = -slope.curvature.ldlt().solve(slope.gradient);
    const double moved =
        std::max({scale_variance(noise_.K_m, 1, change[0], 1e-13, kLargestK_m),
                  scale_variance(noise_.sigma_xy_m, 2, change[1], least_noise_.sigma_xy_m / 2, 1),
                  scale_variance(noise_.sigma_theta_rad, 2, change[2], least_noise_.sigma_theta_rad / 2, 1)});
    if (step == 0) first = moved;
    if (moved < kNoiseSettled) break;
  }
  return first < kNoiseSettled;
}

/// The covariance of the factors treats K as known. If the data hardly determine K (good tyres, a short drive;
/// it may come out as zero), the covariance would be far too small. So K is doubled until -2 log likelihood has
/// risen by 2.7, which is its upper 95 % limit.
void MlFit::widen_uncertain_slip() {
  constexpr double kSurelyKnown = 0.1;  // variance of log K: K is known to a third
  constexpr double kRise = 2.7;
  if (2 * noise_slopes().curvature.inverse()(0, 0) < kSurelyKnown) return;
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    const double cost = cost_of(sums_, unknowns_.front()[kE]) + log_determinant(sums_, fixed_);
    least = std::min(least, cost);
    // Written with !(x <= limit) so that a NaN also ends the loop.
    if (!(cost <= least + kRise && noise_.K_m < kLargestK_m)) return;
    noise_.K_m *= 2;
    maximise();
  }
}

void MlFit::require_plausible() const {
  const Unknowns& u = unknowns_.front();
  const auto outside = [](double ratio) { return !(ratio > 0.5 && ratio < 2); };
  if (outside(u[kCRight]) || outside(u[kCLeft]) || outside(u[kB] / loaded_.b_m))
    throw Error(
        fmt::format("c_R = {:.3g}, c_L = {:.3g} and b = {:.3g} m came out, which no robot of {:.3g} m "
                    "wheelbase has",
                    u[kCRight], u[kCLeft], u[kB], loaded_.b_m),
        {Help::check_units_and_wheels});
}

}  // namespace astro::calibration
