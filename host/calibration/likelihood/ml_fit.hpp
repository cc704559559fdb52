#pragma once

#include <span>
#include <vector>

#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/likelihood/noise_slope.hpp"
#include "host/calibration/likelihood/normal_equations.hpp"
#include "host/calibration/likelihood/sample_selection.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// The search for the most likely unknowns.
namespace astro::calibration {

/// The convergence limits of a search, for the next step: the fall of -2 log likelihood, and the change of the variances'
/// logarithms.
struct Settled {
  double fall = 0, noise = 0;
};

/// Gauss-Newton, damped if the unknowns are far off. If the noise is not given, it is estimated together with the unknowns, and
/// truth is thinned until the innovations are independent (whiteness.hpp).
class MlFit {
 public:
  /// The fit of these runs, which must outlive it.
  /// held   which of the factors and sessions stay as they are given: the factors as `loaded`, lever arms and skews as in
  ///        `start`. The other parameters that are fixed follow from the options and the runs.
  /// start  unknowns of these runs from another fit that are nearly right, one for each run; without them start values are
  ///        sought.
  /// Throws astro::Error for factors that no robot has, and what start_values throws.
  static MlFit of(const PreparedRuns& prepared, const WheelFactors& loaded, const MlOptions& options,
                  FixedParameters held = {}, std::span<const Unknowns> start = {});

  const std::vector<PreparedRun>& runs() const { return runs_; }
  const std::vector<Unknowns>& unknowns() const {
    return state_.unknowns;
  }  // of each run, their shared part equal
  const std::vector<InnovationSums>& sums() const { return state_.sums; }
  /// The sums at the same unknowns without down-weighting of slips.
  std::vector<InnovationSums> sums_with_full_slip_weight() const;
  /// For each run the sums of its stretches, whose information and gradient add up to those of sums() (innovations_by_stretch).
  std::vector<std::vector<InnovationSums>> sums_by_stretch() const;
  const NoiseModel& noise() const { return state_.noise; }
  const FixedParameters& fixed() const { return fixed_; }
  /// The wheel path between the truth samples that the filter uses; less in short runs. 0: it uses all samples.
  double spacing_m() const { return state_.spacing_m; }
  /// The prior of e at the present unknowns.
  PriorOfE prior() const { return {state_.unknowns.front()[kE], prior_weight_}; }
  /// Lets the prior of e count `weight` times. The unknowns move by less than their standard errors, and over that much the
  /// wheels' paths are linear in them, so no further pass is needed.
  void weigh_prior(double weight);
  int iterations() const { return iterations_; }

 private:
  /// The state of the search.
  struct State {
    std::vector<Unknowns> unknowns;
    /// The moves between the samples that the filter uses. They do not contain `last_steps`; unknowns and sums do.
    std::vector<Moves> moves;
    std::vector<Unknowns> last_steps;  // of each run, if they were made
    NoiseModel noise;
    double spacing_m = 0;
    int phases = 1;  // passes along each run, each beginning at another sample
    std::vector<InnovationSums> sums;
    std::vector<std::vector<InnovationSums>> stretches;  // of the last pass, if that was with noise
  };

  MlFit(const PreparedRuns& prepared, const WheelFactors& loaded, const MlOptions& options,
        FixedParameters held, std::vector<Unknowns> start);

  void fit(const MlOptions& options, bool started);
  double kappa0() const { return fixed_.factors ? loaded_.kappa0 : kUsualKappa0; }
  std::vector<Moves> moves_of(std::span<const Unknowns> unknowns) const;
  std::vector<std::vector<InnovationSums>> stretches_anew() const;
  void choose_samples(double spacing_m, int phases);
  SampleSelection samples_of(const PreparedRun& run, int phase) const;
  double cost_of(std::span<const InnovationSums> sums, double e) const;
  std::vector<InnovationSums> pass(std::span<const Moves> moves, RobustMode robust) const;
  void pass_with_noise();
  void take_last_step();
  void take_without_pass(std::span<const Unknowns> steps);
  void take(std::span<const Unknowns> steps);
  double fall_of(std::span<const Unknowns> steps) const;
  void maximise(const Settled& settled);
  NoiseModel next_noise() const;
  void fit_with_noise(const Settled& settled);
  void find_spacing();
  bool innovations_are_independent() const;
  void widen_uncertain_slip();
  /// Wheels between half and twice the nominal ones, and a wheelbase at most so many times the loaded one or less than it.
  bool has_plausible_factors(double most_b) const;
  void start_from_loaded();
  void hold_e_until_noise_is_known();
  void require_plausible() const;

  const std::vector<PreparedRun>& runs_;
  WheelFactors loaded_;
  FixedParameters fixed_;
  NoiseModel least_noise_;
  double prior_weight_;
  State state_;
  NoiseSlope noise_slope_;  // of the last pass with noise
  bool passed_ = false;     // the sums and noise_slope_ are of the unknowns, noise and samples of state_
  RobustMode robust_ = RobustMode::none;
  int iterations_ = 0;
};

}  // namespace astro::calibration
