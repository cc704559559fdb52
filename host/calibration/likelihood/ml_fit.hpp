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

/// What a fit leaves as it is given.
enum class Held {
  nothing,
  factors,
  factors_and_sessions,  // also the lever arms and the skews, which must be in the start values
};

/// Where a search ends: by how much -2 log likelihood would fall with the next step, and how far the logarithms of the variances
/// would go.
struct Settled {
  double fall = 0, noise = 0;
};

/// Whether an e is that of tyres: two standard errors from zero, known to two hundredths, and no larger than tyres can make it.
bool is_shown(const OneUnknown& e);

/// Gauss-Newton, damped where the unknowns are far off. If the noise is not given, it steps together with the unknowns,
/// and truth is thinned until the innovations are independent (whiteness.hpp). If it is not said whether e is to be estimated, that is
/// done only where the runs show it by their noise (is_shown).
///
/// Throws astro::Error for factors that no robot has, and what start_values throws.
class MlFit {
 public:
  /// `prepared` must outlive it. Factors that are held stay as `loaded`. `start`: unknowns of these runs from another fit that
  /// are nearly right, one for each run; without them start values are sought.
  MlFit(const PreparedRuns& prepared, const WheelFactors& loaded, const MlOptions& options,
        Held held = Held::nothing, std::span<const Unknowns> start = {});

  const std::vector<PreparedRun>& runs() const { return runs_; }
  const std::vector<Unknowns>& unknowns() const { return unknowns_; }  // of each run, their shared part equal
  const std::vector<InnovationSums>& sums() const { return sums_; }
  /// At the same unknowns, but without down-weighting slips, however unlikely they are.
  std::vector<InnovationSums> sums_with_full_slip_weight() const;
  /// Of each run by its stretches, whose information and gradient add up to those of sums() (innovations_by_stretch).
  std::vector<std::vector<InnovationSums>> sums_by_stretch() const;
  const NoiseModel& noise() const { return noise_; }
  const FixedParameters& fixed() const { return fixed_; }
  /// The way of the wheels between the truth samples that the filter uses; of short runs less. 0: it uses all.
  double spacing_m() const { return spacing_m_; }
  /// What the runs say about e, estimated or, to first order, not.
  OneUnknown e() const { return e_; }
  int iterations() const { return iterations_; }

 private:
  void fit(const MlOptions& options, bool started);
  void fit_e(const MlOptions& options);
  OneUnknown e_to_first_order() const;
  double kappa0() const { return fixed_.factors ? loaded_.kappa0 : kUsualKappa0; }
  std::vector<Moves> moves_of(std::span<const Unknowns> unknowns) const;
  std::vector<std::vector<InnovationSums>> stretches_anew() const;
  void choose_samples(double spacing_m, int phases);
  SampleSelection samples_of(const PreparedRun& run, int phase) const;
  double cost_of(std::span<const InnovationSums> sums, double e) const;
  std::vector<InnovationSums> pass(std::span<const Moves> moves, RobustMode robust) const;
  void pass_with_noise();
  void take_last_step();
  void take(std::span<const Unknowns> steps);
  double fall_of(std::span<const Unknowns> steps) const;
  void maximise(const Settled& settled);
  NoiseModel next_noise() const;
  void fit_with_noise(const Settled& settled);
  void find_spacing();
  bool innovations_are_independent() const;
  void widen_uncertain_slip();
  void require_plausible() const;

  const std::vector<PreparedRun>& runs_;
  WheelFactors loaded_;
  std::vector<Unknowns> unknowns_;
  /// With these unknowns, between the samples that the filter uses. They lack the last steps: what a pass along them says is
  /// carried on by its information.
  std::vector<Moves> moves_;
  std::vector<Unknowns> last_steps_;  // of each run, if they were made
  FixedParameters fixed_;
  NoiseModel noise_;
  NoiseModel least_noise_;
  NoiseSlope noise_slope_;  // of the last pass with noise
  bool passed_ = false;     // sums_ and noise_slope_ are of these unknowns, noise and samples
  RobustMode robust_ = RobustMode::none;
  double spacing_m_ = 0;
  int phases_ = 1;  // passes along each run, each beginning at another sample
  OneUnknown e_;
  std::vector<InnovationSums> sums_;
  std::vector<std::vector<InnovationSums>> stretches_;  // of the last pass, if that was with noise
  int iterations_ = 0;
};

}  // namespace astro::calibration
