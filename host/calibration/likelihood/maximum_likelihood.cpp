#include "host/calibration/likelihood/maximum_likelihood.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/agreement.hpp"
#include "host/calibration/likelihood/ml_fit.hpp"
#include "host/calibration/likelihood/start_values.hpp"
#include "host/calibration/motion/median_period.hpp"

namespace astro::calibration {
namespace {

// A factor with a larger relative standard error counts as unobserved.
constexpr double kOpen = 0.05;
constexpr double kUnlikely = 1e-3;
constexpr double kEnoughTurning_rad = 6;

// Rounding can turn an infinite variance into one that is not positive.
double root(double variance) {
  return variance > 0 ? std::sqrt(variance) : std::numeric_limits<double>::infinity();
}

/// The runs whose disagreement has a probability below one in a thousand among so many runs.
std::vector<bool> outliers(std::span<const Disagreement> found) {
  const double typical = typical_dispersion(found);
  std::vector<bool> outlier;
  for (const Disagreement& run : found)
    outlier.push_back(chi_square_tail(run.chi_square / typical, run.degrees_of_freedom) *
                          static_cast<double>(found.size()) <
                      kUnlikely);
  return outlier;
}

std::vector<RunFit> summarise_runs(const MlFit& fit, std::span<const Disagreement> found,
                                   const std::vector<bool>& outlier, const SharedInformation& covariance) {
  const std::vector<std::vector<SlipEvent>> slip_events = find_slip_events(fit.runs(), fit.unknowns());
  std::vector<RunFit> summaries;
  for (std::size_t i = 0; i < fit.runs().size(); ++i) {
    const PreparedRun& prepared = fit.runs()[i];
    RunFit run;
    run.name = prepared.source->name;
    run.distance_m = prepared.distance_m;
    run.rotation_rad = prepared.rotation_rad;
    if (!fit.fixed().clock) {
      run.clock_offset_s = fit.unknowns()[i][kClockOffset];
      run.clock_offset_se_s = root(clock_offset_variance(fit.sums()[i], covariance, fit.fixed()));
    }
    run.chi_square = fit.sums()[i].chi_square;
    run.degrees_of_freedom = fit.sums()[i].degrees_of_freedom;
    run.disagreement = found[i].chi_square;
    run.disagreement_dof = found[i].degrees_of_freedom;
    run.outlier = outlier[i];
    run.slip_events = slip_events[i];
    summaries.push_back(run);
  }
  return summaries;
}

/// Nothing if the robot never moved in this way.
std::optional<KindFit> summarise_kind(const MlFit& fit, Motion motion) {
  KindFit kind;
  kind.motion = motion;
  MotionTotals totals;
  int headings = 0, freedom = 0;
  for (std::size_t i = 0; i < fit.runs().size(); ++i) {
    const PreparedRun& run = fit.runs()[i];
    const MotionTotals& part = fit.sums()[i].motion[static_cast<std::size_t>(motion)];
    kind.distance_m += run.extent[static_cast<std::size_t>(motion)].distance_m;
    kind.rotation_rad += run.extent[static_cast<std::size_t>(motion)].rotation_rad;
    totals.samples += part.samples;
    totals.sum_xy_m2 += part.sum_xy_m2;
    totals.sum_theta_rad2 += part.sum_theta_rad2;
    totals.chi_square += part.chi_square;
    headings += run.has_headings ? part.samples : 0;
    freedom += (run.has_headings ? 3 : 2) * part.samples;
  }
  if (totals.samples == 0) return {};
  kind.samples = totals.samples;
  kind.rms_xy_m = std::sqrt(totals.sum_xy_m2 / (2.0 * totals.samples));
  kind.rms_theta_rad = headings > 0 ? std::sqrt(totals.sum_theta_rad2 / headings) : std::nan("");
  kind.chi_square_per_dof = totals.chi_square / freedom;
  return kind;
}

std::optional<WheelbaseByKind> summarise_wheelbase(const MlFit& fit, std::span<const KindFit> kinds) {
  for (const Motion motion : {Motion::arc, Motion::spin})
    if (std::none_of(kinds.begin(), kinds.end(), [&](const KindFit& kind) {
          return kind.motion == motion && kind.rotation_rad > kEnoughTurning_rad;
        }))
      return {};
  const OneUnknown arcs = arc_wheelbase(fit.sums(), fit.fixed());
  if (!std::isfinite(arcs.standard_error)) return {};
  return WheelbaseByKind{1 + arcs.value, arcs.standard_error,
                         std::abs(arcs.value) > std::max(4 * arcs.standard_error, 1e-3)};
}

const PreparedRun& longest(const MlFit& fit) {
  return *std::max_element(
      fit.runs().begin(), fit.runs().end(),
      [](const PreparedRun& a, const PreparedRun& b) { return a.truth.size() < b.truth.size(); });
}

std::vector<Reduced> all_reduced(std::span<const InnovationSums> sums, const FixedParameters& fixed) {
  std::vector<Reduced> runs;
  for (const InnovationSums& run : sums) runs.push_back(reduced(run, fixed, 0));
  return runs;
}

MlEstimate summarise(const MlFit& fit) {
  const std::vector<Reduced> runs = all_reduced(fit.sums(), fit.fixed());
  SharedInformation information = SharedInformation::Zero();
  for (const Reduced& run : runs) information += run.information;
  const std::vector<Disagreement> found =
      disagreements(all_reduced(fit.sums_with_full_slip_weight(), fit.fixed()), fit.fixed());
  const std::vector<bool> outlier = outliers(found);
  // An outlier is down-weighted in the result, so it does not count here. Slips in all runs do.
  std::vector<Disagreement> usual;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!outlier[i]) usual.push_back(found[i]);
  const double widened = dispersion(usual);
  const SharedInformation covariance = widened * shared_covariance(information, fit.fixed());
  const auto se = [&](int unknown) { return root(covariance(unknown, unknown)); };
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Unknowns& u = fit.unknowns().front();

  MlEstimate estimate;
  estimate.factors = {u[kCRight], u[kCLeft], u[kB]};
  estimate.covariance = covariance.topLeftCorner<3, 3>();
  estimate.se = errors_of(estimate.covariance, estimate.factors);
  require_observed(estimate.se, estimate.factors);
  const bool yaw = !fit.fixed().lever_yaw;
  estimate.lever = {u[kLeverX], u[kLeverY], yaw ? std::remainder(u[kLeverYaw], 2 * std::numbers::pi) : none};
  estimate.lever_se = {se(kLeverX), se(kLeverY), yaw ? se(kLeverYaw) : none};
  if (!fit.fixed().clock) {
    estimate.clock_skew = u[kSkew];
    estimate.clock_skew_se = se(kSkew);
  }
  estimate.noise = fit.noise();
  estimate.stride = fit.stride();
  if (fit.stride() > 1) estimate.thinned_to_s = fit.stride() * median_period_s(longest(fit).truth);
  estimate.iterations = fit.iterations();
  estimate.dispersion = widened;
  estimate.runs = summarise_runs(fit, found, outlier, covariance);
  for (const RunFit& run : estimate.runs) {
    estimate.chi_square += run.chi_square;
    estimate.degrees_of_freedom += run.degrees_of_freedom;
  }
  for (const Motion motion : {Motion::rest, Motion::line, Motion::arc, Motion::spin})
    if (const auto kind = summarise_kind(fit, motion)) estimate.kinds.push_back(*kind);
  estimate.wheelbase_by_kind = summarise_wheelbase(fit, estimate.kinds);
  return estimate;
}

/// The covariance of the factors if all unknowns of the runs were at these values: the Cramer-Rao bound.
FactorCovariance bound_of(const PreparedRuns& prepared, const WheelFactors& factors, const LeverArm& lever,
                          const NoiseModel& noise, bool clock_known) {
  FixedParameters fixed;
  fixed.clock = clock_known;
  fixed.lever_yaw = std::none_of(prepared.runs.begin(), prepared.runs.end(),
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
    sums.information = expected_information(Moves(prepared.runs[i], u), noise);
    information += reduced(sums, fixed, 0).information;
  }
  return shared_covariance(information, fixed).topLeftCorner<3, 3>();
}

}  // namespace

MlEstimate estimate_ml(std::span<const Trajectory> runs, const WheelFactors& loaded,
                       const MlOptions& options) {
  const PreparedRuns prepared = prepare(runs, loaded, options.clock_known, Density::independent);
  require_variety(prepared);
  // Checked with the usual noise before the fit, because factors that the runs do not observe diverge in a
  // fit. Not checked without headings: the lever arm is not known yet, and without it spins show nothing.
  if (std::any_of(prepared.runs.begin(), prepared.runs.end(),
                  [](const PreparedRun& run) { return run.has_headings; }))
    require_observed(errors_of(bound_of(prepared, loaded, {}, {}, options.clock_known), loaded), loaded);
  MlEstimate estimate = summarise(MlFit(prepared, loaded, options));
  estimate.left_out = prepared.left_out;
  return estimate;
}

FactorCovariance cramer_rao_bound(std::span<const Trajectory> runs, const WheelFactors& factors,
                                  const LeverArm& lever, const MlOptions& options) {
  // Samples that the estimator does not use must not improve the bound.
  const PreparedRuns prepared = prepare(runs, factors, options.clock_known, Density::independent);
  const FactorCovariance covariance =
      bound_of(prepared, factors, lever, options.noise.value(), options.clock_known);
  require_observed(errors_of(covariance, factors), factors);
  return covariance;
}

MlErrors errors_of(const FactorCovariance& covariance, const WheelFactors& factors) {
  const auto propagated = [&](double by_right, double by_left, double by_b) {
    const Eigen::Vector3d jacobian(by_right, by_left, by_b);
    return root(jacobian.dot(covariance * jacobian));
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

void require_observed(const MlErrors& se, const WheelFactors& factors) {
  if (se.scale < kOpen && se.E_d < kOpen && se.b_m < kOpen * factors.b_m) return;
  throw Error(fmt::format("the runs do not separate c_R, c_L and b (standard errors {:.2g}, {:.2g} and "
                          "{:.2g} m), because all "
                          "of them move alike",
                          se.c_r, se.c_l, se.b_m),
              {Help::drive_lines_and_turns});
}

}  // namespace astro::calibration
