#include "host/calibration/likelihood/ml_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

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

double cost_of(std::span<const InnovationSums> sums) {
  double cost = 0;
  for (const InnovationSums& run : sums) cost += run.cost;
  return cost;
}

/// Changes the logarithm of a variance, which is stored as its `power`-th root, within limits. Returns the size
/// of the actual change.
double scale_variance(double& value, int power, double change, double least, double most) {
  const double step = std::clamp(change, -kLargestNoiseStep, kLargestNoiseStep);
  const double before = value;
  value = std::clamp(before * std::exp(step / power), least, most);
  return std::abs(power * std::log(value / before));
}

}  // namespace

MlFit::MlFit(const PreparedRuns& prepared, const WheelFactors& loaded, const MlOptions& options,
             bool factors_fixed, std::span<const Unknowns> start)
    : runs_(prepared.runs),
      loaded_(loaded),
      unknowns_(start.empty() ? start_values(prepared, loaded)
                              : std::vector<Unknowns>(start.begin(), start.end())),
      noise_(options.noise ? *options.noise : start_noise(prepared)) {
  fixed_.factors = factors_fixed;
  fixed_.clock = options.clock_known;
  fixed_.lever_yaw =
      std::none_of(runs_.begin(), runs_.end(), [](const PreparedRun& run) { return run.has_headings; });
  for (Unknowns& u : unknowns_) {
    if (fixed_.clock) u[kSkew] = u[kClockOffset] = 0;
    if (fixed_.factors) u.head<3>() << loaded.c_r, loaded.c_l, loaded.b_m;
  }
  // The first fit is least squares, because a sample that looks like an outlier to a first guess may be right.
  if (start.empty() || !options.robust || !options.noise) maximise();
  require_plausible();
  if (options.robust) robust_ = RobustMode::tracker_and_wheels;
  if (options.noise) {
    stride_ = options.stride;
    phases_ = std::min(stride_, kMostPhases);
    if (options.robust || stride_ > 1) maximise();
  } else {
    fit_with_noise();
    while (!innovations_are_independent()) {
      stride_ *= 2;
      fit_with_noise();
    }
    if (stride_ > 1) {
      phases_ = std::min(stride_, kMostPhases);
      fit_with_noise();
    }
    widen_uncertain_slip();
  }
  require_plausible();
}

void MlFit::fit_with_noise() {
  for (int round = 0; round < kMostRounds; ++round) {
    const bool settled = fit_noise();
    maximise();
    if (settled) break;
  }
}

bool MlFit::innovations_are_independent() const {
  std::vector<std::vector<Eigen::Vector3d>> all;
  for (std::size_t i = 0; i < runs_.size(); ++i)
    all.push_back(
        standardised_innovations(Moves(runs_[i], unknowns_[i]), noise_, robust_, samples_of(runs_[i], 0)));
  return are_independent(all, kShared + kOwn * static_cast<int>(runs_.size()));
}

std::vector<InnovationSums> MlFit::pass(std::span<const Unknowns> unknowns, RobustMode robust) const {
  std::vector<InnovationSums> sums;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const Moves moves(runs_[i], unknowns[i]);
    std::vector<InnovationSums> passes;
    for (int phase = 0; phase < phases_; ++phase) {
      passes.push_back(innovations(moves, noise_, robust, samples_of(runs_[i], phase)));
    }
    sums.push_back(mean_of(passes));
  }
  return sums;
}

std::vector<InnovationSums> MlFit::sums_with_full_slip_weight() const {
  return pass(unknowns_, std::min(robust_, RobustMode::tracker));
}

NoiseSlope MlFit::noise_slopes() const {
  NoiseSlope sum;
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const Moves moves(runs_[i], unknowns_[i]);
    for (int phase = 0; phase < phases_; ++phase) {
      const NoiseSlope part = noise_slope(moves, noise_, robust_, samples_of(runs_[i], phase));
      sum.gradient += part.gradient / phases_;
      sum.curvature += part.curvature / phases_;
    }
  }
  // Without headings nothing determines their noise. This keeps it where it is.
  sum.curvature.diagonal().array() += 1e-9;
  return sum;
}

/// Thinned truth begins at several samples (phases), so that the result does not depend on one of them. Their
/// likelihoods are averaged, not added, because all of them contain the same slip. A short run is thinned
/// less.
SampleSelection MlFit::samples_of(const PreparedRun& run, int phase) const {
  const int stride = std::clamp(static_cast<int>(run.truth.size()) / kFewestSamples, 1, stride_);
  return {stride, phase * stride / phases_};
}

void MlFit::maximise() {
  double damping = 0;
  sums_ = pass(unknowns_, robust_);
  for (int step = 0; step < kMostSteps; ++step) {
    ++iterations_;
    const std::vector<Unknowns> steps = gauss_newton_step(sums_, fixed_, damping);
    double expected = 0;
    std::vector<Unknowns> next = unknowns_;
    for (std::size_t i = 0; i < next.size(); ++i) {
      next[i] += steps[i];
      expected += steps[i].dot(sums_[i].gradient);
    }
    std::vector<InnovationSums> sums = pass(next, robust_);
    const double fall = cost_of(sums_) - cost_of(sums);
    if (fall > -kSettled) {
      unknowns_ = std::move(next);
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
    const double moved = std::max({scale_variance(noise_.K_m, 1, change[0], 1e-13, kLargestK_m),
                                   scale_variance(noise_.sigma_xy_m, 2, change[1], 1e-7, 1),
                                   scale_variance(noise_.sigma_theta_rad, 2, change[2], 1e-7, 1)});
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
    const double cost = cost_of(sums_) + log_determinant(sums_, fixed_);
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
