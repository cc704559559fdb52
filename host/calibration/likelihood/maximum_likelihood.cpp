#include "host/calibration/likelihood/maximum_likelihood.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/agreement.hpp"
#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/likelihood/likelihood_problem.hpp"
#include "host/calibration/likelihood/ml_fit.hpp"
#include "host/calibration/likelihood/moved_body.hpp"
#include "host/calibration/likelihood/moves.hpp"
#include "host/calibration/likelihood/normal_equations.hpp"
#include "host/calibration/likelihood/sample_selection.hpp"
#include "host/calibration/likelihood/start_values.hpp"
#include "host/calibration/preparation/courses.hpp"
#include "host/calibration/preparation/sessions.hpp"

namespace astro::calibration {
namespace {

// A factor with a larger relative standard error counts as unobserved.
constexpr double kOpen = 0.05;
constexpr int kMostSplits = 5;

// Rounding can turn an infinite variance into one that is not positive.
double root(double variance) {
  return variance > 0 ? std::sqrt(variance) : std::numeric_limits<double>::infinity();
}

FixedParameters fixed_in_bound(std::span<const PreparedRun> runs, bool with_e, bool clock_known) {
  FixedParameters fixed;
  fixed.clock = clock_known;
  fixed.e = !with_e;
  fixed.lever_yaw =
      std::none_of(runs.begin(), runs.end(), [](const PreparedRun& run) { return run.has_headings; });
  return fixed;
}

/// The covariance that the factors would have if all unknowns of the runs were at given values: the Cramer-Rao bound.
class ExpectedBound {
 public:
  /// `runs` is only asked whether any of them has headings.
  ExpectedBound(std::span<const PreparedRun> runs, const WheelFactors& factors, const LeverArm& lever,
                const NoiseModel& noise, bool clock_known, double spacing_m);

  void add(const PreparedRun& run, const ClockFit& clock);
  /// The bound with the runs that were added so far. Each further run can only reduce it.
  FactorMatrix covariance() const { return pool_.factor_covariance(); }

 private:
  const WheelFactors factors_;
  const LeverArm lever_;
  const NoiseModel noise_;
  const double spacing_m_;
  const FixedParameters fixed_;
  Pool pool_;
};

ExpectedBound::ExpectedBound(std::span<const PreparedRun> runs, const WheelFactors& factors,
                             const LeverArm& lever, const NoiseModel& noise, bool clock_known,
                             double spacing_m)
    : factors_(factors),
      lever_(lever),
      noise_(noise),
      spacing_m_(spacing_m),
      fixed_(fixed_in_bound(runs, factors.e != 0, clock_known)),
      pool_(fixed_) {}

void ExpectedBound::add(const PreparedRun& run, const ClockFit& clock) {
  Unknowns u = Unknowns::Zero();
  u.head<kShared>() << factors_.c_r, factors_.c_l, factors_.b_m, factors_.e, lever_.x_m, lever_.y_m,
      lever_.theta_rad, clock.skew;
  u[kClockOffset] = clock.offset_s;
  InnovationSums sums;
  sums.session = run.session;
  const SampleSelection samples = selection_of(run.path_m, spacing_m_);
  sums.information = expected_information(Moves(run, u, kUsualKappa0, {samples}), noise_, samples);
  pool_.add(reduced(sums, fixed_, 0));
}

std::vector<RunFit> summarise_runs(const MlFit& fit, std::span<const Disagreement> found,
                                   const std::vector<bool>& outlier, const Pool& pool, double widening) {
  const std::vector<std::vector<SlipEvent>> slip_events = find_slip_events(fit.runs(), fit.unknowns());
  std::vector<RunFit> summaries;
  for (std::size_t i = 0; i < fit.runs().size(); ++i) {
    const PreparedRun& prepared = fit.runs()[i];
    RunFit run;
    run.name = prepared.source->name;
    run.distance_m = prepared.distance_m;
    run.rotation_rad = prepared.rotation_rad;
    run.session = prepared.session;
    if (!fit.fixed().clock) {
      run.clock_offset_s = fit.unknowns()[i][kClockOffset];
      run.clock_offset_se_s = root(
          clock_offset_variance(fit.sums()[i], widening * pool.covariance(prepared.session), fit.fixed()));
    }
    run.chi_square = fit.sums()[i].chi_square;
    run.degrees_of_freedom = fit.sums()[i].degrees_of_freedom;
    if (prepared.source->ends_only) run.degrees_of_freedom -= 3;  // its start is fitted to one of two poses
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

SessionFit summarise_session(const Unknowns& u, const SharedInformation& covariance,
                             const FixedParameters& fixed) {
  const auto se = [&](int unknown) { return root(covariance(unknown, unknown)); };
  const double none = std::numeric_limits<double>::quiet_NaN();
  const bool yaw = !fixed.lever_yaw;
  SessionFit session;
  session.lever = wrapped(lever_of(u));
  if (!yaw) session.lever.theta_rad = none;
  session.lever_se = {se(kLeverX), se(kLeverY), yaw ? se(kLeverYaw) : none};
  if (!fixed.clock) {
    session.clock_skew = u[kSkew];
    session.clock_skew_se = se(kSkew);
  }
  return session;
}

std::vector<Reduced> all_reduced(std::span<const InnovationSums> sums, const FixedParameters& fixed) {
  std::vector<Reduced> runs;
  for (const InnovationSums& run : sums) runs.push_back(reduced(run, fixed, 0));
  return runs;
}

/// What is fixed where runs are compared with each other. An e of which they say less than was known before is not compared:
/// between samples that are close to each other counts flicker, because they are whole numbers, and on the lines of a square that
/// looks like curves, in each run like others.
FixedParameters fixed_where_compared(const MlFit& fit) {
  constexpr double kPriorVariance = PriorOfE::kStandardDeviation * PriorOfE::kStandardDeviation;
  FixedParameters fixed = fit.fixed();
  if (pool_of(fit.sums(), fixed, fit.prior()).factor_covariance()(kE, kE) > kPriorVariance / 2)
    fixed.e = true;
  return fixed;
}

double widening(const MlFit& fit, const std::vector<bool>& outlier, const FixedParameters& fixed) {
  const std::vector<int> courses = find_courses(fit.runs());
  const std::vector<std::vector<InnovationSums>> stretches = fit.sums_by_stretch();
  std::vector<RunInStretches> runs;
  for (std::size_t i = 0; i < courses.size(); ++i)
    runs.push_back({reduced(fit.sums()[i], stretches[i], fixed), courses[i], outlier[i]});
  return clustered_dispersion(runs, fixed, fit.spacing_m() > 0, fit.prior());
}

MlEstimate summarise(MlFit fit) {
  const FixedParameters compared = fixed_where_compared(fit);
  const std::vector<Disagreement> found =
      disagreements(all_reduced(fit.sums_with_full_slip_weight(), compared), compared, fit.spacing_m() > 0);
  const std::vector<bool> outlier = outliers(found);
  // An outlier is down-weighted in the result, so it does not count here. Slips in all runs do.
  std::vector<Disagreement> usual;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!outlier[i]) usual.push_back(found[i]);

  MlEstimate estimate;
  estimate.dispersion = dispersion(usual);
  estimate.widening = std::max(estimate.dispersion, widening(fit, outlier, compared));
  fit.weigh_prior(estimate.widening);
  const Pool pool = pool_of(fit.sums(), fit.fixed(), fit.prior());
  estimate.factors = factors_of(fit.unknowns().front());
  estimate.covariance = estimate.widening * pool.factor_covariance();
  const std::vector<int> days = find_days(fit.runs());
  estimate.drift = drift_between_days(fit.sums(), days, fit.fixed(), fit.prior(), estimate.factors);
  estimate.covariance_another_day = covariance_on_another_day(
      fit.sums(), days, fit.fixed(), fit.prior(), estimate.factors, estimate.covariance, estimate.drift);
  estimate.se = errors_of(estimate.covariance, estimate.factors);
  require_observed(estimate.se, estimate.factors);
  for (int session = 0; session < session_count(fit.runs()); ++session)
    for (std::size_t i = 0; i < fit.runs().size(); ++i) {
      if (fit.runs()[i].session != session) continue;
      estimate.sessions.push_back(
          summarise_session(fit.unknowns()[i], estimate.widening * pool.covariance(session), fit.fixed()));
      break;
    }
  estimate.noise = fit.noise();
  estimate.spacing_m = fit.spacing_m();
  estimate.iterations = fit.iterations();
  estimate.runs = summarise_runs(fit, found, outlier, pool, estimate.widening);
  for (const RunFit& run : estimate.runs) {
    estimate.chi_square += run.chi_square;
    estimate.degrees_of_freedom += run.degrees_of_freedom;
  }
  estimate.ends_only =
      std::ranges::all_of(fit.runs(), [](const PreparedRun& run) { return run.source->ends_only; });
  if (!estimate.ends_only)
    for (const Motion motion : {Motion::rest, Motion::line, Motion::arc, Motion::spin})
      if (const auto kind = summarise_kind(fit, motion)) estimate.kinds.push_back(*kind);
  std::vector<ClockFit> clocks;
  for (const Unknowns& u : fit.unknowns()) clocks.push_back({u[kClockOffset], u[kSkew]});
  estimate.eccentricities = find_eccentricities(fit.runs(), clocks, estimate.factors);
  return estimate;
}

bool are_observed(const MlErrors& se, const WheelFactors& factors) {
  return se.scale < kOpen && se.E_d < kOpen && se.b_m < kOpen * factors.b_m;
}

/// Checked with the usual noise before the fit, because factors that the runs do not observe diverge in a fit. The runs are
/// added one by one, and mostly the first one is enough.
void require_observable(const PreparedRuns& prepared, const WheelFactors& loaded, bool clock_known) {
  ExpectedBound bound(prepared.runs, {loaded.c_r, loaded.c_l, loaded.b_m}, {}, {}, clock_known,
                      kRoughSpacing * loaded.b_m);
  MlErrors se;
  for (std::size_t i = 0; i < prepared.runs.size(); ++i) {
    bound.add(prepared.runs[i], prepared.clocks[i]);
    se = errors_of(bound.covariance(), loaded);
    if (are_observed(se, loaded)) return;
  }
  require_observed(se, loaded);
}

}  // namespace

MlEstimate estimate_ml(std::span<const Trajectory> runs, const WheelFactors& loaded,
                       const MlOptions& options) {
  return fit_ml(runs, loaded, options).estimate;
}

MlFitted fit_ml(std::span<const Trajectory> runs, const WheelFactors& loaded, const MlOptions& options) {
  PreparedRuns prepared = prepare(runs, loaded, options.clock_known, Density::independent);
  require_variety(prepared);
  // Skipped if no run has headings, because the lever arm is not known yet, and without it spins show
  // nothing.
  if (std::any_of(prepared.runs.begin(), prepared.runs.end(),
                  [](const PreparedRun& run) { return run.has_headings; }))
    require_observable(prepared, loaded, options.clock_known);
  std::optional<MlFit> fit = MlFit::of(prepared, loaded, options);
  // Places that are far apart pass for noise as long as they are taken for one, and hide those that are closer.
  for (int round = 0; round < kMostSplits && split_sessions(*fit, prepared); ++round)
    fit.emplace(MlFit::of(prepared, loaded, options));
  std::vector<Unknowns> unknowns = fit->unknowns();
  MlEstimate estimate = summarise(*std::move(fit));
  estimate.left_out = prepared.left_out;
  estimate.mended = prepared.mended;
  return {std::move(estimate), {std::move(prepared), std::move(unknowns)}};
}

FactorCovariance cramer_rao_bound(std::span<const Trajectory> runs, const WheelFactors& factors,
                                  const LeverArm& lever, const MlOptions& options) {
  // Samples that the estimator does not use must not improve the bound.
  const PreparedRuns prepared = prepare(runs, factors, options.clock_known, Density::independent);
  ExpectedBound bound(prepared.runs, factors, lever, options.noise.value(), options.clock_known, 0);
  for (std::size_t i = 0; i < prepared.runs.size(); ++i) bound.add(prepared.runs[i], prepared.clocks[i]);
  require_observed(errors_of(bound.covariance(), factors), factors);
  return bound.covariance();
}

MlErrors errors_of(const FactorCovariance& covariance, const WheelFactors& factors) {
  const auto propagated = [&](double by_right, double by_left, double by_b) {
    const FactorVector jacobian(by_right, by_left, by_b, 0);
    return root(jacobian.dot(covariance * jacobian));
  };
  const double scale = (factors.c_r + factors.c_l) / 2, b_over_scale_m = factors.b_m / scale;
  MlErrors se;
  se.c_r = propagated(1, 0, 0);
  se.c_l = propagated(0, 1, 0);
  se.b_m = propagated(0, 0, 1);
  se.e = covariance(kE, kE) == 0 ? 0 : root(covariance(kE, kE));
  se.E_d = propagated(1 / factors.c_l, -factors.c_r / (factors.c_l * factors.c_l), 0);
  se.scale = propagated(0.5, 0.5, 0);
  se.b_over_scale_m = propagated(-b_over_scale_m / scale / 2, -b_over_scale_m / scale / 2, 1 / scale);
  return se;
}

void require_observed(const MlErrors& se, const WheelFactors& factors) {
  if (are_observed(se, factors)) return;
  throw Error(fmt::format("the runs do not separate c_R, c_L and b (standard errors {:.2g}, {:.2g} and "
                          "{:.2g} m), because all "
                          "of them move alike: drive both ways round, and lines as well as turns",
                          se.c_r, se.c_l, se.b_m),
              LikelihoodProblem::all_move_alike);
}

}  // namespace astro::calibration
