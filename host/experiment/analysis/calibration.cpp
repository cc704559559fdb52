#include "host/experiment/analysis/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"
#include "host/calibration/end_poses/misfit.hpp"
#include "host/calibration/judgement/end_pose_validation.hpp"
#include "host/calibration/judgement/remarks.hpp"
#include "host/calibration/likelihood/noise_of_ends.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/scan_sentences.hpp"
#include "host/experiment/analysis/scanned_runs.hpp"
#include "host/experiment/files/method_names.hpp"

namespace astro::experiment {
namespace {

using Family = MethodChoice::Family;

calibration::Options options_for(const MethodChoice& method) {
  if (method.family == Family::end_poses) return method.options;
  calibration::Options options;
  options.method = calibration::Method::robust;
  return options;
}

using Phases = std::span<const std::shared_ptr<const Recordings>>;

/// Scans calibrate by another method than poses, so neither is chosen for a person who has both.
void refuse_both(Phases phases) {
  const std::string *with = nullptr, *without = nullptr;
  for (const auto& phase : phases)
    for (std::size_t i = 0; i < phase->runs().size(); ++i)
      (phase->runs()[i].scans.empty() ? without : with) = &phase->names()[i];
  if (with == nullptr || without == nullptr) return;
  throw Error(fmt::format("{} has the scans of a laser scanner and {} has none, and both kinds are not "
                          "calibrated together unless a method is named: leave one kind out",
                          *with, *without),
              AnalysisProblem::only_some_have_scans, {*with, *without});
}

/// What `automatic` means for these runs.
Family family_of(Phases phases, const MethodChoice& method) {
  if (method.family != Family::automatic) return method.family;
  refuse_both(phases);
  const auto all = [&](const auto& is) {
    return std::all_of(phases.begin(), phases.end(), [&](const auto& phase) {
      return std::all_of(phase->runs().begin(), phase->runs().end(), is);
    });
  };
  if (all([](const recording::Run& run) { return !run.scans.empty(); })) return Family::scans;
  if (all([](const recording::Run& run) { return has_moving_truth(run.info); })) return Family::ml;
  return Family::end_poses;
}

/// Not an error if there are no squares, or not in both directions, or not all alike: maximum likelihood needs
/// none and only shows them.
std::optional<calibration::ExperimentSummary> summary_of_squares(const Recordings& recordings) {
  try {
    const Squares& squares = recordings.squares();
    if (!squares.cw.empty() && !squares.ccw.empty()) return calibration::summarize(squares.cw, squares.ccw);
  } catch (const Error&) {
  }
  return std::nullopt;
}

/// The trajectories of all phases. Those of each phase are comparable already.
std::vector<calibration::Trajectory> all_trajectories(Phases phases) {
  std::vector<calibration::Trajectory> all;
  const Recordings& first = *phases.front();
  for (const auto& phase : phases) {
    const std::vector<calibration::Trajectory>& runs = phase->trajectories();
    require_comparable(first.runs().front().info, first.names().front(), phase->runs().front().info,
                       phase->names().front());
    all.insert(all.end(), runs.begin(), runs.end());
  }
  return all;
}

/// Start times are in whole seconds. If several are equal, the last of these runs counts.
calibration::WheelFactors last_loaded(Phases phases) {
  const recording::RunInfo* last = &phases.front()->runs().front().info;
  for (const auto& phase : phases)
    for (const recording::Run& run : phase->runs())
      if (run.info.started_at >= last->started_at) last = &run.info;
  return loaded_factors(*last);
}

std::vector<std::string> session_names(std::span<const calibration::Trajectory> runs,
                                       const calibration::MlEstimate& estimate) {
  std::vector<std::string> names(estimate.sessions.size());
  for (const calibration::RunFit& fit : estimate.runs) {
    const auto run = std::ranges::find(runs, fit.name, &calibration::Trajectory::name);
    if (run != runs.end()) names.at(static_cast<std::size_t>(fit.session)) = run->session;
  }
  return names;
}

double truth_scale_sigma(const recording::Run& run) {
  if (run.scans.empty() || run.info.truth_scale_sigma > 0) return run.info.truth_scale_sigma;
  return lidar::kRangeScaleSigma;
}

double truth_scale_sigma(Phases phases) {
  double most = 0;
  for (const auto& phase : phases)
    for (const recording::Run& run : phase->runs()) most = std::max(most, truth_scale_sigma(run));
  return most;
}

/// Multiplies all three factors by one ratio, so that their scale becomes that of `scaled`.
calibration::WheelFactors with_scale_of(const calibration::WheelFactors& scaled,
                                        calibration::WheelFactors factors) {
  const double keep = (scaled.c_r + scaled.c_l) / (factors.c_r + factors.c_l);
  factors.c_r *= keep;
  factors.c_l *= keep;
  factors.b_m *= keep;
  return factors;
}

/// c_R, c_L, b and e, as an error of the scale changes them: all lengths alike.
Eigen::Vector4d lengths_of(const calibration::WheelFactors& factors) {
  return {factors.c_r, factors.c_l, factors.b_m, 0};
}

/// Adds the scale error of the truth to the estimate.
void add_scale_error(double sigma, const calibration::WheelFactors& loaded,
                     calibration::MlEstimate& estimate) {
  calibration::WheelFactors& factors = estimate.factors;
  const Eigen::Vector4d lengths = lengths_of(factors);
  // The scale may be unknown. Then the loaded one stays, and the covariance loses what the drives seem to tell about the scale.
  const bool known = std::isfinite(sigma);
  const double keep = (loaded.c_r + loaded.c_l) / (factors.c_r + factors.c_l);
  Eigen::Matrix4d jacobian = Eigen::Matrix4d::Identity();
  jacobian -= lengths * Eigen::RowVector4d(1, 1, 0, 0) / (factors.c_r + factors.c_l);
  jacobian.topRows<3>() *= keep;
  for (calibration::FactorCovariance* covariance : {&estimate.covariance, &estimate.covariance_another_day}) {
    if (known)
      *covariance += sigma * sigma * lengths * lengths.transpose();
    else
      *covariance = jacobian * (*covariance) * jacobian.transpose();
  }
  if (!known) factors = with_scale_of(loaded, factors);
  estimate.se = calibration::errors_of(estimate.covariance, factors);
}

/// Refuses a single drive whose clocks run further apart than clocks do, because one drive may show as a skew what is none: a
/// step, or wheels and truth of two drives. Several drives that share it confirm it.
void require_likely_skew(const calibration::MlEstimate& estimate) {
  constexpr double kMost = 5e-3;
  for (std::size_t i = 0; i < estimate.sessions.size(); ++i) {
    const auto ppm = calibration::skew_beyond(estimate.sessions[i], kMost);
    const auto is_of_session = [&](const calibration::RunFit& run) {
      return run.session == static_cast<int>(i);
    };
    if (!ppm || std::ranges::count_if(estimate.runs, is_of_session) != 1) continue;
    const std::string name = std::ranges::find_if(estimate.runs, is_of_session)->name,
                      apart = fmt::format("{:.0f}", std::abs(*ppm));
    throw Error(
        fmt::format(
            "{}: the clocks of robot and ground truth run {} ppm apart, which clocks do not, and no other "
            "drive confirms it",
            name, apart),
        AnalysisProblem::clocks_run_apart, {name, apart});
  }
}

FactorErrors factor_errors(const calibration::FactorCovariance& covariance, const Calibration& found) {
  const calibration::WheelFactors& loaded = found.loaded;
  const calibration::MlErrors se = calibration::errors_of(covariance, found.factors);
  return {se.c_r,
          se.c_l,
          se.b_m,
          se.E_d * loaded.c_l / loaded.c_r,
          se.b_m / loaded.b_m,
          std::isinf(found.truth_scale_sigma) ? FactorErrors::kUnknown : se.scale,
          se.e};
}

Calibration by_ml(Phases phases, const MlChoice& choice) {
  const std::vector<calibration::Trajectory> runs = all_trajectories(phases);
  const Recordings& first = *phases.front();
  Calibration result;
  result.loaded = last_loaded(phases);
  MlResult ml;
  ml.options.clock_known = std::all_of(phases.begin(), phases.end(), [&](const auto& phase) {
    return clock_known(phase->set(), choice.clock);
  });
  ml.options.noise = choice.noise;
  ml.noise_given = choice.noise.has_value();
  if (!choice.noise && std::ranges::all_of(runs, &calibration::Trajectory::ends_only))
    ml.options.noise = calibration::noise_of_ends(runs, result.loaded, ml.options);
  auto [estimate, drives] = calibration::fit_ml(runs, result.loaded, ml.options);
  ml.estimate = std::move(estimate);
  if (choice.clock != MlChoice::Clock::estimated) require_likely_skew(ml.estimate);
  ml.session_names = session_names(runs, ml.estimate);
  result.truth_scale_sigma = truth_scale_sigma(phases);
  // If nobody measured a length, the loaded scale stays. The loaded factors are then compared at the estimated scale, so
  // that the scale does not count in the judgement.
  const calibration::WheelFactors compared = std::isinf(result.truth_scale_sigma)
                                                 ? with_scale_of(ml.estimate.factors, result.loaded)
                                                 : result.loaded;
  result.judgement = calibration::cross_validate(drives, compared, ml.estimate, ml.options,
                                                 !std::isinf(result.truth_scale_sigma));
  if (result.truth_scale_sigma > 0) add_scale_error(result.truth_scale_sigma, result.loaded, ml.estimate);
  result.factors = ml.estimate.factors;
  result.se = factor_errors(ml.estimate.covariance, result);
  result.drift = ml.estimate.drift;
  result.covariance_another_day = ml.estimate.covariance_another_day;
  result.se_another_day = factor_errors(ml.estimate.covariance_another_day, result);
  result.robot = identity_of(first.runs().front().info);
  result.wheel = nominal_wheel(first.runs().front().info, first.names().front());
  result.squares = summary_of_squares(*phases.back());
  result.detail = std::move(ml);
  return result;
}

Calibration by_scans(Phases phases) {
  const Recordings& first = *phases.front();
  std::vector<lidar::ScannedDrive> drives;
  for (const auto& phase : phases) {
    for (std::size_t i = 0; i < phase->runs().size(); ++i)
      require_comparable(first.runs().front().info, first.names().front(), phase->runs()[i].info,
                         phase->names()[i]);
    std::ranges::move(scanned_drives(phase->set()), std::back_inserter(drives));
  }
  Calibration result =
      calibration_of(lidar::calibrate_by_scans(drives, last_loaded(phases)), truth_scale_sigma(phases));
  result.robot = identity_of(first.runs().front().info);
  result.wheel = nominal_wheel(first.runs().front().info, first.names().front());
  result.squares = summary_of_squares(*phases.back());
  return result;
}

/// The squares of the last phase with the lines of all.
Squares squares_and_lines(Phases phases) {
  Squares squares = phases.back()->squares();
  for (const auto& phase : phases.first(phases.size() - 1)) {
    const std::vector<calibration::LineEnd>& lines = phase->squares().lines;
    squares.lines.insert(squares.lines.end(), lines.begin(), lines.end());
  }
  return squares;
}

Calibration by_end_poses(Phases phases, const MethodChoice& method) {
  Calibration result = calibrate(squares_and_lines(phases), method);
  const Recordings& recordings = *phases.back();
  const recording::RunInfo& info = recordings.runs().front().info;
  result.robot = identity_of(info);
  // Recordings of other origin may lack the wheel. The ratios that end poses give do not need it.
  if (info.parameters.contains("wheel_diameter"))
    result.wheel = nominal_wheel(info, recordings.names().front());
  return result;
}

/// Applies the scale from lines. It multiplies both wheels and the wheelbase by one ratio, because a closed square stays
/// closed.
void apply(const calibration::LineScale& scale, Calibration& result) {
  const double change = scale.scale / result.scale();
  const double part = scale.se / scale.scale;
  calibration::WheelFactors& factors = result.factors;
  factors.c_r *= change;
  factors.c_l *= change;
  factors.b_m *= change;  // e and kappa0 are ratios of wheelbases
  const auto widened = [&](double error, double value) {
    return value * std::hypot(change * error / value, part);
  };
  FactorErrors& se = result.se;
  se.c_r = widened(se.c_r, factors.c_r);
  se.c_l = widened(se.c_l, factors.c_l);
  se.b_m = widened(se.b_m, factors.b_m);
  se.E_b = se.b_m / result.loaded.b_m;
  se.scale = scale.se;
  result.line_scale = scale;
}

/// Adds what robots change by from one day to another to the errors of end poses, which know E_d and b / S and, from lines, S. The
/// factors found are better than those in use only beyond that.
void add_drift(Calibration& result) {
  const calibration::WheelFactors& factors = result.factors;
  const FactorErrors& own = result.se;
  const bool has_scale = result.line_scale.has_value();
  const double own_scale = has_scale ? own.scale / result.scale() : 0;
  const double own_base =
      std::sqrt(std::max(0.0, std::pow(own.b_m / factors.b_m, 2) - own_scale * own_scale));
  const calibration::DayDrift errors{std::hypot(own.E_d / result.E_d(), result.drift.E_d),
                                     has_scale ? std::hypot(own_scale, result.drift.scale) : 0,
                                     std::hypot(own_base, result.drift.b_over_scale),
                                     calibration::PriorOfE::kStandardDeviation};
  if (!std::isfinite(errors.E_d + errors.b_over_scale)) return;  // too few runs for a scatter
  const calibration::FactorCovariance covariance = errors.covariance(factors);
  FactorErrors& se = result.se_another_day;
  se = factor_errors(covariance, result);
  se.e = FactorErrors::kUnknown;  // nobody looked for it
  if (has_scale)
    result.covariance_another_day = covariance;
  else
    se.scale = FactorErrors::kUnknown;
  const double base = result.E_b() / (has_scale ? result.scale_change() : 1);
  const int shown = has_scale ? 3 : 2;
  const Eigen::Vector3d change(result.E_d() - 1, base - 1, result.scale_change() - 1),
      own_errors(own.E_d / result.E_d(), own_base, own_scale),
      on_another_day(errors.E_d, errors.b_over_scale, errors.scale);
  const auto covariance_of = [&](const Eigen::Vector3d& independent) -> Eigen::MatrixXd {
    return independent.head(shown).cwiseAbs2().asDiagonal();
  };
  result.judgement.weigh_against_drift(change.head(shown), covariance_of(own_errors),
                                       covariance_of(on_another_day));
}

/// What scans say of the factors.
void take_factors(const lidar::ScanCalibration& found, Calibration& result) {
  result.factors = found.factors;
  result.se = factor_errors(found.covariance, result);
  result.covariance_another_day = found.covariance + result.drift.covariance(found.factors);
  result.se_another_day = factor_errors(*result.covariance_another_day, result);
}

void require_truth(Phases phases) {
  for (const auto& phase : phases)
    for (const recording::Run& run : phase->runs())
      if (!run.truth.empty() || !run.scans.empty()) return;
  throw Error("none of the recordings has ground truth, so nothing tells where the robot really was",
              AnalysisProblem::no_truth);
}

Calibration calibrate_phases(Phases phases, const MethodChoice& method, const MlChoice& ml) {
  require_truth(phases);
  switch (family_of(phases, method)) {
    case Family::ml:
      return by_ml(phases, ml);
    case Family::scans:
      return by_scans(phases);
    default:
      return by_end_poses(phases, method);
  }
}

/// estimate_factors, whose errors name a run by its direction and number; these say before it where the run is from.
calibration::Estimate estimate_of(const Squares& squares, const calibration::Options& options) {
  using calibration::EndPoseProblem;
  try {
    return calibration::estimate_factors(squares.cw, squares.ccw, squares.side_m, squares.loaded, options);
  } catch (const Error& error) {
    if (error.kind() != Kind(EndPoseProblem::no_heading) &&
        error.kind() != Kind(EndPoseProblem::heading_beyond_half_a_turn))
      throw;
    const auto& from = error.values()[0] == in_words(Sense::cw) ? squares.cw_from : squares.ccw_from;
    if (from.empty()) throw;
    throw Error(error.in(from.at(std::stoul(error.values()[1]) - 1) + ": "));
  }
}

}  // namespace

bool clock_known(const RunSet& set, MlChoice::Clock clock) {
  if (clock != MlChoice::Clock::automatic) return clock == MlChoice::Clock::known;
  return std::all_of(set.runs.begin(), set.runs.end(), [](const recording::Run& run) {
    return run.info.truth_clock == "robot" || run.truth.size() == 2;
  });
}

std::string_view Calibration::method() const {
  if (const calibration::Estimate* estimate = end_poses())
    return calibration::name_of(estimate->options.method);
  return scans() != nullptr ? kScanName : kMlName;
}

double Calibration::E_d() const {
  if (const calibration::Estimate* estimate = end_poses()) return estimate->E_d;
  return factors.c_r / factors.c_l / (loaded.c_r / loaded.c_l);
}

double Calibration::E_b() const {
  if (const calibration::Estimate* estimate = end_poses(); estimate != nullptr && !line_scale)
    return estimate->E_b;
  return factors.b_m / loaded.b_m;
}

double Calibration::scale_change() const { return 2 * scale() / (loaded.c_r + loaded.c_l); }

Calibration calibrate(const Squares& squares, const MethodChoice& method) {
  if (method.family == Family::ml || method.family == Family::scans)
    throw Error("this method needs whole drives with ground truth, and end poses are all there is",
                AnalysisProblem::end_poses_only);
  const calibration::Options options = options_for(method);
  const calibration::Estimate estimate = estimate_of(squares, options);
  Calibration result;
  result.judgement =
      calibration::cross_validate(squares.cw, squares.ccw, squares.side_m, squares.loaded, options);
  result.loaded = estimate.loaded;
  result.factors = estimate.factors;
  result.factors.e = estimate.loaded.e;
  result.factors.kappa0 = estimate.loaded.kappa0;
  result.se = {estimate.se.c_r, estimate.se.c_l, estimate.se.b_m,
               estimate.se.E_d, estimate.se.E_b, FactorErrors::kUnknown};
  result.squares = estimate.summary;
  result.detail = estimate;
  result.left_out = squares.left_out;
  result.misfit = calibration::misfit_of(squares.cw, squares.ccw, {squares.side_m, squares.loaded});
  if (const auto scale = calibration::scale_of_lines(squares.lines)) {
    calibration::cross_validate_scale(squares.lines, squares.loaded, *scale, result.judgement);
    apply(*scale, result);
  }
  add_drift(result);
  return result;
}

Calibration calibration_of(lidar::ScanCalibration found, double range_scale_sigma) {
  const Eigen::Vector4d lengths = lengths_of(found.factors);
  found.covariance += range_scale_sigma * range_scale_sigma * lengths * lengths.transpose();
  Calibration result;
  result.truth_scale_sigma = range_scale_sigma;
  result.loaded = found.loaded;
  result.judgement.verdict = verdict_of(found);
  take_factors(found, result);
  result.detail = std::move(found);
  return result;
}

void weigh_loaded_scale(double sigma, Calibration& result) {
  auto& found = std::get<lidar::ScanCalibration>(result.detail);
  calibration::WheelFactors& factors = found.factors;
  const double loaded = (found.loaded.c_r + found.loaded.c_l) / 2;
  const Eigen::Vector4d by(0.5, 0.5, 0, 0), with_scale = found.covariance * by;
  const double variance = by.dot(with_scale) + std::pow(sigma * loaded, 2), apart = loaded - result.scale();
  const Eigen::Vector4d gain = with_scale / variance, change = gain * apart;
  factors.c_r += change(0);
  factors.c_l += change(1);
  factors.b_m += change(2);
  factors.e += change(3);
  found.covariance -= gain * with_scale.transpose();
  result.loaded_scale_sigma = sigma;
  result.loaded_scale_apart = std::abs(apart) / std::sqrt(variance);
  take_factors(found, result);
}

Calibration calibrate(const Recordings& recordings, const MethodChoice& method, const MlChoice& ml) {
  // The pointer does not own the recordings; the caller keeps them.
  const std::shared_ptr<const Recordings> phase(std::shared_ptr<void>(), &recordings);
  return calibrate_phases({&phase, 1}, method, ml);
}

Calibration calibrate_after(std::span<const std::shared_ptr<const Recordings>> phases,
                            const MethodChoice& method, const MlChoice& ml) {
  return calibrate_phases(phases, method, ml);
}

}  // namespace astro::experiment
