#include "host/calibration/maximum_likelihood.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/base/error.hpp"
#include "host/calibration/agreement.hpp"
#include "host/calibration/normal_equations.hpp"
#include "host/calibration/start_values.hpp"

namespace astro::calibration {
namespace {

constexpr int kMostSteps = 30, kMostRounds = 6;
// A cost that falls by less has parameters that move by less than a twentieth of their standard errors.
constexpr double kSettled = 1e-3;
constexpr double kNoiseSettled = 0.01;  // of the logarithms of the variances
constexpr double kLargestNoiseStep = 2;
// A factor less certain than this is not measured at all.
constexpr double kOpen = 0.05;
constexpr double kUnlikely = 1e-3;
constexpr double kEnoughTurning_rad = 6;

class Fit {
 public:
  Fit(const PreparedRuns& prepared, const WheelFactors& carried, const MlOptions& options)
      : runs_(prepared.runs),
        carried_(carried),
        options_(options),
        unknowns_(start_values(prepared, carried)) {
    held_.clock = options.clock_known;
    held_.lever_yaw =
        std::none_of(runs_.begin(), runs_.end(), [](const PreparedRun& run) { return run.has_headings; });
    noise_ = options.noise ? *options.noise : start_noise(prepared);
    if (options.clock_known) hold_clock();
  }

  MlEstimate run() {
    // A first guess is judged by least squares: what seems an outlier to it may be the truth.
    maximise(false);
    require_plausible();
    if (!options_.noise) {
      for (int round = 0; round < kMostRounds; ++round) {
        const bool settled = fit_noise();
        maximise(options_.robust);
        if (settled) break;
      }
    } else if (options_.robust) {
      maximise(true);
    }
    require_plausible();
    return report();
  }

 private:
  void hold_clock() {
    for (Unknowns& u : unknowns_) u[kSkew] = u[kClockOffset] = 0;
  }

  static double cost_of(std::span<const InnovationSums> sums) {
    double cost = 0;
    for (const InnovationSums& run : sums) cost += run.cost;
    return cost;
  }

  std::vector<InnovationSums> pass(std::span<const Unknowns> unknowns, bool huber) const {
    std::vector<InnovationSums> sums;
    for (std::size_t i = 0; i < runs_.size(); ++i)
      sums.push_back(innovations(runs_[i], unknowns[i], noise_, huber));
    return sums;
  }

  void maximise(bool huber) {
    double damping = 0;
    sums_ = pass(unknowns_, huber);
    for (int step = 0; step < kMostSteps; ++step) {
      ++iterations_;
      const std::vector<Unknowns> steps = gauss_newton_step(sums_, held_, damping);
      double expected = 0;
      std::vector<Unknowns> next = unknowns_;
      for (std::size_t i = 0; i < next.size(); ++i) {
        next[i] += steps[i];
        expected += steps[i].dot(sums_[i].gradient);
      }
      std::vector<InnovationSums> sums = pass(next, huber);
      const double fall = cost_of(sums_) - cost_of(sums);
      if (fall > -kSettled) {
        unknowns_ = std::move(next);
        sums_ = std::move(sums);
        damping = damping < 1e-3 ? 0 : damping / 10;
      } else {
        damping = std::max(10 * damping, 1e-3);
        if (damping > 1e6) return;
      }
      if (expected < kSettled || std::abs(fall) < kSettled) return;
    }
  }

  /// Fisher's scoring in the logarithms; true if hardly anything changed.
  bool fit_noise() {
    double largest = 0;
    for (int step = 0; step < 20; ++step) {
      NoiseSlope slope;
      for (std::size_t i = 0; i < runs_.size(); ++i) {
        const NoiseSlope run = noise_slope(runs_[i], unknowns_[i], noise_, options_.robust);
        slope.gradient += run.gradient;
        slope.curvature += run.curvature;
      }
      // Without headings their noise is told by nothing and stays.
      slope.curvature.diagonal().array() += 1e-9;
      const Eigen::Vector3d change = (-slope.curvature.ldlt().solve(slope.gradient))
                                         .cwiseMax(-kLargestNoiseStep)
                                         .cwiseMin(kLargestNoiseStep);
      noise_.K_m = std::clamp(noise_.K_m * std::exp(change[0]), 1e-13, 1e-2);
      noise_.sigma_xy_m = std::clamp(noise_.sigma_xy_m * std::exp(change[1] / 2), 1e-7, 1.0);
      noise_.sigma_theta_rad = std::clamp(noise_.sigma_theta_rad * std::exp(change[2] / 2), 1e-7, 1.0);
      const double moved = change.cwiseAbs().maxCoeff();
      if (step == 0) largest = moved;
      if (moved < kNoiseSettled) break;
    }
    return largest < kNoiseSettled;
  }

  void require_plausible() const {
    const Unknowns& u = unknowns_.front();
    const auto outside = [](double ratio) { return !(ratio > 0.5 && ratio < 2); };
    if (outside(u[kCRight]) || outside(u[kCLeft]) || outside(u[kB] / carried_.b_m))
      throw Error(
          fmt::format("c_R = {:.3g}, c_L = {:.3g} and b = {:.3g} m came out, which no robot of {:.3g} m "
                      "wheelbase has: check the "
                      "unit of the ground truth, the wheel diameter and the counts of a turn",
                      u[kCRight], u[kCLeft], u[kB], carried_.b_m));
  }

  std::vector<Reduced> reduced_runs() const {
    std::vector<Reduced> all;
    for (const InnovationSums& run : sums_) all.push_back(reduced(run, held_, 0));
    return all;
  }

  MlEstimate report() const;
  void report_runs(MlEstimate& estimate, const SharedInformation& covariance) const;
  void report_kinds(MlEstimate& estimate) const;

  const std::vector<PreparedRun>& runs_;
  const WheelFactors carried_;
  const MlOptions& options_;
  std::vector<Unknowns> unknowns_;
  Held held_;
  NoiseModel noise_;
  std::vector<InnovationSums> sums_;
  int iterations_ = 0;
};

FactorCovariance factor_covariance(const SharedInformation& covariance) {
  FactorCovariance factors{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      factors[i][k] = covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  return factors;
}

void require_observed(const MlErrors& se, const WheelFactors& factors) {
  if (se.scale < kOpen && se.E_d < kOpen && se.b_m < kOpen * factors.b_m) return;
  throw Error(
      fmt::format("the runs leave c_R, c_L and b open against each other (standard errors {:.2g}, {:.2g} and "
                  "{:.2g} m), because all "
                  "of them move alike: drive both ways round, and lines as well as turns",
                  se.c_r, se.c_l, se.b_m));
}

double root(double variance) { return std::sqrt(std::max(variance, 0.0)); }

MlEstimate Fit::report() const {
  MlEstimate estimate;
  const Unknowns& u = unknowns_.front();
  SharedInformation information = SharedInformation::Zero();
  for (const Reduced& run : reduced_runs()) information += run.information;
  const SharedInformation covariance = shared_covariance(information, held_);
  const auto se = [&](int unknown) { return root(covariance(unknown, unknown)); };
  estimate.factors = {u[kCRight], u[kCLeft], u[kB]};
  estimate.covariance = factor_covariance(covariance);
  estimate.se = errors_of(estimate.covariance, estimate.factors);
  require_observed(estimate.se, estimate.factors);
  const double none = std::numeric_limits<double>::quiet_NaN();
  estimate.lever = {u[kLeverX], u[kLeverY],
                    held_.lever_yaw ? none : std::remainder(u[kLeverYaw], 2 * std::numbers::pi)};
  estimate.lever_se = {se(kLeverX), se(kLeverY), held_.lever_yaw ? none : se(kLeverYaw)};
  if (!held_.clock) {
    estimate.clock_skew = u[kSkew];
    estimate.clock_skew_se = se(kSkew);
  }
  estimate.noise = noise_;
  estimate.iterations = iterations_;
  report_runs(estimate, covariance);
  report_kinds(estimate);
  return estimate;
}

void Fit::report_runs(MlEstimate& estimate, const SharedInformation& covariance) const {
  const std::vector<Disagreement> found = disagreements(reduced_runs(), held_);
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    RunFit fit;
    fit.name = runs_[i].source->name;
    fit.distance_m = runs_[i].distance_m;
    fit.rotation_rad = runs_[i].rotation_rad;
    if (!held_.clock) {
      fit.clock_offset_s = unknowns_[i][kClockOffset];
      fit.clock_offset_se_s = root(clock_offset_variance(sums_[i], covariance, held_));
    }
    fit.chi_square = sums_[i].chi_square;
    fit.degrees_of_freedom = sums_[i].degrees_of_freedom;
    fit.disagreement = found[i].chi_square;
    fit.disagreement_dof = found[i].degrees_of_freedom;
    fit.outlier =
        chi_square_tail(fit.disagreement, fit.disagreement_dof) * static_cast<double>(runs_.size()) <
        kUnlikely;
    estimate.chi_square += fit.chi_square;
    estimate.degrees_of_freedom += fit.degrees_of_freedom;
    estimate.runs.push_back(fit);
  }
}

void Fit::report_kinds(MlEstimate& estimate) const {
  double arc_rad = 0, spin_rad = 0;
  for (const Motion motion : {Motion::rest, Motion::line, Motion::arc, Motion::spin}) {
    KindFit kind;
    kind.motion = motion;
    MotionTotals totals;
    int headings = 0, freedom = 0;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const MotionTotals& part = sums_[i].motion[static_cast<std::size_t>(motion)];
      const MotionExtent& extent = runs_[i].extent[static_cast<std::size_t>(motion)];
      kind.distance_m += extent.distance_m;
      kind.rotation_rad += extent.rotation_rad;
      totals.samples += part.samples;
      totals.sum_xy_m2 += part.sum_xy_m2;
      totals.sum_theta_rad2 += part.sum_theta_rad2;
      totals.chi_square += part.chi_square;
      headings += runs_[i].has_headings ? part.samples : 0;
      freedom += (runs_[i].has_headings ? 3 : 2) * part.samples;
    }
    if (totals.samples == 0) continue;
    if (motion == Motion::arc) arc_rad = kind.rotation_rad;
    if (motion == Motion::spin) spin_rad = kind.rotation_rad;
    kind.samples = totals.samples;
    kind.rms_xy_m = std::sqrt(totals.sum_xy_m2 / (2.0 * totals.samples));
    kind.rms_theta_rad = headings > 0 ? std::sqrt(totals.sum_theta_rad2 / headings) : std::nan("");
    kind.chi_square_per_dof = totals.chi_square / freedom;
    estimate.kinds.push_back(kind);
  }
  if (arc_rad < kEnoughTurning_rad || spin_rad < kEnoughTurning_rad) return;
  const OneUnknown arcs = arc_wheelbase(sums_, held_);
  if (!std::isfinite(arcs.standard_error)) return;
  estimate.wheelbase_by_kind = {1 + arcs.value, arcs.standard_error,
                                std::abs(arcs.value) > std::max(3 * arcs.standard_error, 1e-3)};
}

}  // namespace

MlEstimate estimate_ml(std::span<const Trajectory> runs, const WheelFactors& carried,
                       const MlOptions& options) {
  const PreparedRuns prepared = prepare(runs, carried, options.clock_known);
  return Fit(prepared, carried, options).run();
}

FactorCovariance cramer_rao_bound(std::span<const Trajectory> runs, const WheelFactors& factors,
                                  const LeverArm& lever, const MlOptions& options) {
  const PreparedRuns prepared = prepare(runs, factors, options.clock_known);
  Held held;
  held.clock = options.clock_known;
  held.lever_yaw = std::none_of(prepared.runs.begin(), prepared.runs.end(),
                                [](const PreparedRun& run) { return run.has_headings; });
  SharedInformation information = SharedInformation::Zero();
  for (std::size_t i = 0; i < prepared.runs.size(); ++i) {
    Unknowns u = Unknowns::Zero();
    u[kCRight] = factors.c_r;
    u[kCLeft] = factors.c_l;
    u[kB] = factors.b_m;
    u[kLeverX] = lever.x_m;
    u[kLeverY] = lever.y_m;
    u[kLeverYaw] = lever.yaw_rad;
    u[kSkew] = prepared.clocks[i].skew;
    u[kClockOffset] = prepared.clocks[i].offset_s;
    InnovationSums sums;
    sums.information = expected_information(prepared.runs[i], u, options.noise.value());
    information += reduced(sums, held, 0).information;
  }
  const FactorCovariance covariance = factor_covariance(shared_covariance(information, held));
  require_observed(errors_of(covariance, factors), factors);
  return covariance;
}

MlErrors errors_of(const FactorCovariance& covariance, const WheelFactors& factors) {
  const auto propagated = [&](double by_right, double by_left, double by_b) {
    const double by[3] = {by_right, by_left, by_b};
    double variance = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) variance += by[i] * covariance[i][k] * by[k];
    return root(variance);
  };
  const double scale = (factors.c_r + factors.c_l) / 2, b_over_scale_m = factors.b_m / scale;
  MlErrors se;
  se.c_r = propagated(1, 0, 0);
  se.c_l = propagated(0, 1, 0);
  se.b_m = propagated(0, 0, 1);
  se.E_d = propagated(1 / factors.c_l, -factors.c_r / (factors.c_l * factors.c_l), 0);
  se.scale = propagated(0.5, 0.5, 0);
  se.b_over_scale_m = propagated(-b_over_scale_m / scale / 2, -b_over_scale_m / scale / 2, 1 / scale);
  return se;
}

}  // namespace astro::calibration
