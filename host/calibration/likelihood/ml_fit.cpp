#include "host/calibration/likelihood/ml_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/likelihood_problem.hpp"
#include "host/calibration/likelihood/start_values.hpp"
#include "host/calibration/likelihood/whiteness.hpp"

namespace astro::calibration {
namespace {

constexpr int kMostSteps = 30, kMostRounds = 40;
// When a search has settled, its next step is within a thirtieth of the standard errors. This step is still
// made, so that the remaining error is far less.
constexpr Settled kSettled{1e-3, 0.002}, kRoughly{1, 0.1};
constexpr double kLargestNoiseStep = 2;
// A step of the unknowns may need damping if the expected fall of the cost exceeds kFarFall, or exceeds both kNearFall and the
// fall expected in the round before. Both are for up to ten runs. The cost is a sum over runs, so with more runs the same error of
// the unknowns makes it fall by more.
constexpr double kFarFall = 1e4, kNearFall = 100;
constexpr double kUsualRuns = 10;
constexpr double kLargestK_m = 1e-2;
constexpr double kMostE = 0.3;  // ten times that of any robot
constexpr int kMostPhases = 4;
constexpr int kStretches = 4;  // one per side of a square, within which wind-up and unwinding cancel
// If the innovations of all samples are not independent, this is the smallest spacing that is tried. Wind-up in a spin and
// unwinding on the next line must lie between the same two samples more often than not, and a quarter turn is 0.8 wheelbases of
// the wheels' path. The spacing is no simple multiple of that, because the samples would then fall on the same place of every
// corner.
constexpr double kLeastSpacing = 1.25;  // wheelbases

// A wheelbase beyond these parts of the loaded one was measured to the centre, or across the robot.
constexpr double kHalfWheelbase = 0.56, kTwiceWheelbase = 1.8;

/// The `power`-th root of a variance of which the logarithm changes by `change`, within limits.
double scaled(double value, int power, double change, double least, double most) {
  const double step = std::clamp(change, -kLargestNoiseStep, kLargestNoiseStep);
  return std::clamp(value * std::exp(step / power), least, most);
}

/// The largest difference of the logarithms of the variances.
double distance(const NoiseModel& a, const NoiseModel& b) {
  return std::max({std::abs(std::log(b.K_m / a.K_m)), 2 * std::abs(std::log(b.sigma_xy_m / a.sigma_xy_m)),
                   2 * std::abs(std::log(b.sigma_theta_rad / a.sigma_theta_rad))});
}

/// Whether wheels and ground truth go about as far, seen at steps that are longer than noise.
bool go_equally_far(std::span<const PreparedRun> runs) {
  constexpr double kStep_m = 0.3;
  double wheels_m = 0, truth_m = 0;
  for (const PreparedRun& run : runs) {
    wheels_m += run.distance_m;
    const BodySample* from = &run.truth.front();
    for (const BodySample& sample : run.truth) {
      const double step_m = std::hypot(sample.x_m - from->x_m, sample.y_m - from->y_m);
      if (step_m < kStep_m) continue;
      truth_m += step_m;
      from = &sample;
    }
  }
  return truth_m > 0.5 * wheels_m && truth_m < 2 * wheels_m;
}

/// Predicts the sums of the next pass after a small step from the information of the last pass.
void make_step(InnovationSums& sums, const Unknowns& step) {
  const Unknowns change = sums.information * step;
  sums.cost -= step.dot(2 * sums.gradient - change);
  sums.gradient -= change;
}

/// The mean of each stretch over several passes along one run.
std::vector<InnovationSums> mean_of_stretches(std::span<const std::vector<InnovationSums>> passes) {
  std::vector<InnovationSums> means;
  for (std::size_t k = 0; k < passes.front().size(); ++k) {
    std::vector<InnovationSums> of_stretch;
    for (const std::vector<InnovationSums>& pass : passes) of_stretch.push_back(pass[k]);
    means.push_back(mean_of(of_stretch));
  }
  return means;
}

}  // namespace

MlFit MlFit::of(const PreparedRuns& prepared, const WheelFactors& loaded, const MlOptions& options,
                FixedParameters held, std::span<const Unknowns> start) {
  MlFit fit(prepared, loaded, options, held,
            start.empty() ? start_values(prepared, loaded) : std::vector(start.begin(), start.end()));
  fit.fit(options, !start.empty());
  return fit;
}

MlFit::MlFit(const PreparedRuns& prepared, const WheelFactors& loaded, const MlOptions& options,
             FixedParameters held, std::vector<Unknowns> start)
    : runs_(prepared.runs),
      loaded_(loaded),
      fixed_{.factors = held.factors,
             .e = held.factors || !options.with_e,
             .session = held.session,
             .clock = options.clock_known,
             .lever_yaw = std::none_of(runs_.begin(), runs_.end(),
                                       [](const PreparedRun& run) { return run.has_headings; })},
      least_noise_(options.noise ? *options.noise : start_noise(prepared)),
      prior_weight_(options.widening) {
  state_.unknowns = std::move(start);
  for (Unknowns& u : state_.unknowns) {
    if (fixed_.clock) u[kSkew] = u[kClockOffset] = 0;
    if (fixed_.factors)
      u.head<kFactors>() << loaded.c_r, loaded.c_l, loaded.b_m, loaded.e;
    else if (fixed_.e)
      u[kE] = 0;
  }
}

/// Where counts are so coarse that e runs away with the first guess of the noise, the noise is found without e.
void MlFit::hold_e_until_noise_is_known() {
  for (Unknowns& u : state_.unknowns) u.head<kFactors>() << loaded_.c_r, loaded_.c_l, loaded_.b_m, 0;
  state_.moves = moves_of(state_.unknowns);
  state_.noise = least_noise_;
  const bool fixed_e = std::exchange(fixed_.e, true);
  choose_samples(0, 1);
  find_spacing();
  fixed_.e = fixed_e;
  passed_ = false;
}

void MlFit::fit(const MlOptions& options, bool started) {
  state_.noise = least_noise_;
  // The first fit is least squares, because a sample that looks like an outlier to a first guess may be right.
  if (!started) {
    choose_samples(kRoughSpacing * loaded_.b_m, 1);
    // Before the noise is known, its prior hardly holds e against the rounding of coarse counts.
    const bool fixed_e = std::exchange(fixed_.e, true);
    maximise(kRoughly);
    fixed_.e = fixed_e;
    if (!has_plausible_factors(4))
      start_from_loaded();  // the stated wheelbase may be half or twice the right one
  }
  choose_samples(0, 1);
  if (options.robust) robust_ = RobustMode::tracker_and_wheels;
  if (options.noise) {
    choose_samples(options.spacing_m, options.spacing_m > 0 ? kMostPhases : 1);
    maximise(kSettled);
  } else {
    find_spacing();
    if (!fixed_.e && !(std::abs(state_.unknowns.front()[kE]) < kMostE)) hold_e_until_noise_is_known();
    fit_with_noise(kSettled);
    widen_uncertain_slip();
  }
  take_last_step();
  require_plausible();
}

std::vector<Moves> MlFit::moves_of(std::span<const Unknowns> unknowns) const {
  std::vector<Moves> moves;
  moves.reserve(runs_.size());
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    std::vector<SampleSelection> selections;
    for (int phase = 0; phase < state_.phases && state_.spacing_m > 0; ++phase)
      selections.push_back(samples_of(runs_[i], phase));
    moves.emplace_back(runs_[i], unknowns[i], kappa0(), selections);
  }
  return moves;
}

void MlFit::choose_samples(double spacing_m, int phases) {
  if (!state_.moves.empty() && spacing_m == state_.spacing_m && phases == state_.phases) return;
  passed_ = false;
  state_.spacing_m = spacing_m;
  state_.phases = phases;
  state_.moves = moves_of(state_.unknowns);
}

double MlFit::cost_of(std::span<const InnovationSums> sums, double e) const {
  double cost = fixed_.e ? 0 : PriorOfE{e, prior_weight_}.cost();
  for (const InnovationSums& run : sums) cost += run.cost;
  return cost;
}

/// Noise and unknowns step together after one pass. The information has no cross terms between them, so both steps are Newton
/// steps.
void MlFit::fit_with_noise(const Settled& settled) {
  const double size = std::max(1.0, static_cast<double>(runs_.size()) / kUsualRuns);
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kMostRounds; ++round) {
    if (!passed_) pass_with_noise();
    const std::vector<Unknowns> steps = gauss_newton_step(state_.sums, fixed_, 0, prior());
    const double expected = fall_of(steps);
    const NoiseModel noise = next_noise();
    const double noise_moved = distance(state_.noise, noise);
    if (noise_moved < settled.noise && expected < settled.fall) return;
    state_.noise = noise;
    const bool goes_wrong = expected > kNearFall * size && expected > before;
    before = expected;
    if (expected < kFarFall * size && !goes_wrong)
      take(steps);
    else
      maximise(settled);
  }
  maximise(settled);
}

/// Makes a step that is so small that another pass would only confirm it. The sums after it follow from the information of the
/// last pass.
void MlFit::take_last_step() {
  const std::vector<Unknowns> steps = gauss_newton_step(state_.sums, fixed_, 0, prior());
  if (!(fall_of(steps) < kSettled.fall)) return;
  take_without_pass(steps);
}

void MlFit::take_without_pass(std::span<const Unknowns> steps) {
  passed_ = false;
  state_.last_steps.resize(steps.size(), Unknowns::Zero());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    state_.last_steps[i] += steps[i];
    state_.unknowns[i] += steps[i];
    make_step(state_.sums[i], steps[i]);
  }
}

void MlFit::weigh_prior(double weight) {
  prior_weight_ = weight;
  take_without_pass(gauss_newton_step(state_.sums, fixed_, 0, prior()));
}

void MlFit::take(std::span<const Unknowns> steps) {
  passed_ = false;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    state_.unknowns[i] += steps[i];
    state_.moves[i].change(state_.unknowns[i]);
  }
}

/// Doubles the spacing of the samples until the innovations are independent.
void MlFit::find_spacing() {
  fit_with_noise(kRoughly);
  double widest_m = 0;  // further apart than this, each run would have the same few samples
  for (const PreparedRun& run : runs_) widest_m = std::max(widest_m, widest_spacing_m(run.path_m.back()));
  while (state_.spacing_m < widest_m && !innovations_are_independent()) {
    choose_samples(std::max(2 * state_.spacing_m, kLeastSpacing * loaded_.b_m), 1);
    fit_with_noise(kRoughly);
  }
  if (state_.spacing_m > 0) choose_samples(state_.spacing_m, kMostPhases);
}

bool MlFit::innovations_are_independent() const {
  const int fitted = kShared + kOwn * static_cast<int>(runs_.size());
  std::vector<std::vector<Eigen::Vector3d>> by_run;
  for (const Moves& run : state_.moves)
    by_run.push_back(standardised_innovations(run, state_.noise, robust_, samples_of(run.run(), 0)));
  if (!are_independent(by_run, fitted)) return false;
  std::vector<std::vector<Eigen::Vector3d>> spacings(1);
  for (const auto& run : by_run) spacings[0].insert(spacings[0].end(), run.begin(), run.end());
  // Closer spacings are not tested here, because errors that come and go within a few samples show in the
  // sums over neighbours.
  SampleSelection samples{std::max(2 * state_.spacing_m, kLeastSpacing / 2 * loaded_.b_m)};
  std::vector<Moves> moves;
  for (std::size_t i = 0; i < runs_.size(); ++i)
    moves.push_back(state_.spacing_m == 0 ? state_.moves[i].joined(samples)
                                          : Moves(runs_[i], state_.unknowns[i], kappa0(), {samples}));
  while (true) {
    std::vector<Eigen::Vector3d>& wider = spacings.emplace_back();
    for (const Moves& run : moves) {
      const auto of_run = standardised_innovations(run, state_.noise, robust_, samples);
      wider.insert(wider.end(), of_run.begin(), of_run.end());
    }
    if (wider.size() < fewest_innovations(fitted)) break;
    samples.spacing_m *= 2;
    for (Moves& run : moves) run = run.joined(samples);
  }
  return hold_over_path(spacings, fitted);
}

std::vector<InnovationSums> MlFit::pass(std::span<const Moves> moves, RobustMode robust) const {
  std::vector<InnovationSums> sums;
  for (const Moves& run : moves) {
    std::vector<InnovationSums> passes;
    for (int phase = 0; phase < state_.phases; ++phase)
      passes.push_back(innovations(run, state_.noise, robust, samples_of(run.run(), phase)));
    sums.push_back(mean_of(passes));
  }
  return sums;
}

std::vector<InnovationSums> MlFit::sums_with_full_slip_weight() const {
  std::vector<InnovationSums> sums = pass(state_.moves, std::min(robust_, RobustMode::tracker));
  for (std::size_t i = 0; i < state_.last_steps.size(); ++i) make_step(sums[i], state_.last_steps[i]);
  return sums;
}

std::vector<std::vector<InnovationSums>> MlFit::sums_by_stretch() const {
  std::vector<std::vector<InnovationSums>> sums =
      state_.stretches.empty() ? stretches_anew() : state_.stretches;
  for (std::size_t i = 0; i < state_.last_steps.size(); ++i)
    for (InnovationSums& stretch : sums[i]) make_step(stretch, state_.last_steps[i]);
  return sums;
}

std::vector<std::vector<InnovationSums>> MlFit::stretches_anew() const {
  std::vector<std::vector<InnovationSums>> sums;
  for (const Moves& run : state_.moves) {
    std::vector<std::vector<InnovationSums>> passes;
    for (int phase = 0; phase < state_.phases; ++phase)
      passes.push_back(
          innovations_by_stretch(run, state_.noise, robust_, samples_of(run.run(), phase), kStretches));
    sums.push_back(mean_of_stretches(passes));
  }
  return sums;
}

void MlFit::pass_with_noise() {
  ++iterations_;
  state_.sums.clear();
  state_.stretches.clear();
  noise_slope_ = {};
  for (const Moves& run : state_.moves) {
    std::vector<InnovationSums> passes;
    std::vector<std::vector<InnovationSums>> in_stretches;
    for (int phase = 0; phase < state_.phases; ++phase) {
      const auto [of_run, of_stretches, of_noise] =
          innovations_and_noise(run, state_.noise, robust_, samples_of(run.run(), phase), kStretches);
      passes.push_back(of_run);
      in_stretches.push_back(of_stretches);
      noise_slope_.gradient += of_noise.gradient / state_.phases;
      noise_slope_.curvature += of_noise.curvature / state_.phases;
    }
    state_.sums.push_back(mean_of(passes));
    state_.stretches.push_back(mean_of_stretches(in_stretches));
  }
  passed_ = true;
  // Without headings nothing determines their noise, and only rounding would move it.
  if (fixed_.lever_yaw) {
    noise_slope_.gradient[2] = 0;
    noise_slope_.curvature.row(2).setZero();
    noise_slope_.curvature.col(2).setZero();
  }
  noise_slope_.curvature.diagonal().array() += 1e-9;
}

/// Thinned truth begins at several samples (phases), so that the result does not depend on one of them. Their
/// likelihoods are averaged, not added, because all of them contain the same slip.
SampleSelection MlFit::samples_of(const PreparedRun& run, int phase) const {
  return selection_of(run.path_m, state_.spacing_m, static_cast<double>(phase) / state_.phases);
}

/// Searches the unknowns, with the noise held.
void MlFit::maximise(const Settled& settled) {
  double damping = 0;
  passed_ = false;
  state_.stretches.clear();
  state_.sums = pass(state_.moves, robust_);
  for (int step = 0; step < kMostSteps; ++step) {
    const std::vector<Unknowns> steps = gauss_newton_step(state_.sums, fixed_, damping, prior());
    // A damped step is small because of the damping, so it does not show convergence.
    if (damping == 0 && fall_of(steps) < settled.fall) return;
    ++iterations_;
    std::vector<Unknowns> next = state_.unknowns;
    for (std::size_t i = 0; i < next.size(); ++i) next[i] += steps[i];
    std::vector<Moves> moves = moves_of(next);
    std::vector<InnovationSums> sums = pass(moves, robust_);
    const double fall = cost_of(state_.sums, state_.unknowns.front()[kE]) - cost_of(sums, next.front()[kE]);
    if (fall > -kSettled.fall) {
      state_.unknowns = std::move(next);
      state_.moves = std::move(moves);
      state_.sums = std::move(sums);
      damping = damping < 1e-3 ? 0 : damping / 10;
    } else {
      damping = std::max(10 * damping, 1e-3);
      if (damping > 1e6) return;
    }
  }
}

/// By how much -2 log likelihood falls with these steps if it is as curved as the information says.
double MlFit::fall_of(std::span<const Unknowns> steps) const {
  double fall = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) fall += steps[i].dot(state_.sums[i].gradient);
  return fall;
}

/// By one step of Fisher's scoring in the logarithms of the variances.
NoiseModel MlFit::next_noise() const {
  const Eigen::Vector3d change = -noise_slope_.curvature.ldlt().solve(noise_slope_.gradient);
  return {scaled(state_.noise.K_m, 1, change[0], 1e-13, kLargestK_m),
          scaled(state_.noise.sigma_xy_m, 2, change[1], least_noise_.sigma_xy_m / 2, 1),
          scaled(state_.noise.sigma_theta_rad, 2, change[2], least_noise_.sigma_theta_rad / 2, 1)};
}

/// The covariance of the factors treats K as known. If the data hardly determine K (good tyres, a short drive;
/// it may come out as zero), the covariance would be far too small. So K is doubled until -2 log likelihood has
/// risen by 2.7, which is its upper 95 % limit.
void MlFit::widen_uncertain_slip() {
  constexpr double kSurelyKnown = 0.1;  // variance of log K: K is known to a third
  constexpr double kRise = 2.7;
  if (!passed_) pass_with_noise();
  if (2 * noise_slope_.curvature.inverse()(0, 0) < kSurelyKnown) return;
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    const double cost =
        cost_of(state_.sums, state_.unknowns.front()[kE]) + log_determinant(state_.sums, fixed_, prior());
    least = std::min(least, cost);
    // Written with !(x <= limit) so that a NaN also ends the loop.
    if (!(cost <= least + kRise && state_.noise.K_m < kLargestK_m)) return;
    state_.noise.K_m *= 2;
    maximise(kSettled);
  }
}

bool MlFit::has_plausible_factors(double most_b) const {
  const Unknowns& u = state_.unknowns.front();
  const auto inside = [](double ratio) { return ratio > 0.5 && ratio < 2; };
  const double b_ratio = u[kB] / loaded_.b_m;
  return inside(u[kCRight]) && inside(u[kCLeft]) && b_ratio > 1 / most_b && b_ratio < most_b;
}

/// Only the result is judged: a rough fit of noisy truth may stray. If the wheels did not go about as far as the truth, no fit
/// helps, and the reason is known.
void MlFit::start_from_loaded() {
  if (!go_equally_far(runs_)) require_plausible();
  for (Unknowns& u : state_.unknowns) u.head<kFactors>() << loaded_.c_r, loaded_.c_l, loaded_.b_m, u[kE];
  state_.moves = moves_of(state_.unknowns);
  passed_ = false;
}

void MlFit::require_plausible() const {
  const Unknowns& u = state_.unknowns.front();
  const double b_ratio = u[kB] / loaded_.b_m;
  const auto like_loaded = [](double c) { return c > 0.8 && c < 1.25; };
  const bool sizes_fit = like_loaded(u[kCRight] / loaded_.c_r) && like_loaded(u[kCLeft] / loaded_.c_l);
  if (sizes_fit && (b_ratio < kHalfWheelbase || b_ratio > kTwiceWheelbase)) {
    const std::string b = fmt::format("{:.3g}", u[kB]), loaded = fmt::format("{:.3g}", loaded_.b_m);
    throw Error(
        fmt::format(
            "the wheels have the stated size, but the wheelbase comes out as {} m instead of {} m: it is "
            "the distance between the wheels, not that from one to the centre, nor the robot's width",
            b, loaded),
        LikelihoodProblem::wheelbase_unlike, {b, loaded});
  }
  if (has_plausible_factors(2)) return;
  const std::string found = fmt::format(
      "c_R = {:.3g}, c_L = {:.3g} and b = {:.3g} m came out, which no robot of {:.3g} m wheelbase has",
      u[kCRight], u[kCLeft], u[kB], loaded_.b_m);
  if (go_equally_far(runs_))
    throw Error(found +
                    ", although its wheels go as far as the ground truth: check the stamps of both, which "
                    "may be times of arrival, the resolution of the encoders and of the ground truth, and "
                    "whether the tracked body stayed where it was on the robot",
                LikelihoodProblem::stamps_or_resolution);
  // Few ends do not show their handedness (preparation/handedness.hpp).
  const bool ends = std::ranges::all_of(runs_, [](const PreparedRun& run) { return run.source->ends_only; });
  throw Error(found + ": check " + (ends ? "that the left and right wheels are not exchanged, " : "") +
                  "the unit of the ground truth, the wheel diameter and the counts of a turn",
              LikelihoodProblem::implausible_factors);
}

}  // namespace astro::calibration
