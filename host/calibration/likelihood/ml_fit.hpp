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

/// Gauss-Newton, damped if necessary. If the noise is not given, it is fitted in alternation with the unknowns,
/// and truth is thinned until the innovations are independent (whiteness.hpp).
///
/// Throws astro::Error for factors that no robot has, and what start_values throws.
class MlFit {
 public:
  /// `prepared` must outlive it. With `factors_fixed` c_R, c_L and b stay as `loaded`, and only the nuisance
  /// parameters are fitted. `start`: unknowns of these runs from another fit that are nearly right, one for each run; without
  /// them start values are sought.
  MlFit(const PreparedRuns& prepared, const WheelFactors& loaded, const MlOptions& options,
        bool factors_fixed = false, std::span<const Unknowns> start = {});

  const std::vector<PreparedRun>& runs() const { return runs_; }
  const std::vector<Unknowns>& unknowns() const { return unknowns_; }  // of each run, their shared part equal
  const std::vector<InnovationSums>& sums() const { return sums_; }
  /// At the same unknowns, but without down-weighting slips, however unlikely they are.
  std::vector<InnovationSums> sums_with_full_slip_weight() const;
  const NoiseModel& noise() const { return noise_; }
  const FixedParameters& fixed() const { return fixed_; }
  /// The filter uses every so many-th truth sample; of short runs more.
  int stride() const { return stride_; }
  int iterations() const { return iterations_; }

 private:
  SampleSelection samples_of(const PreparedRun& run, int phase) const;
  std::vector<InnovationSums> pass(std::span<const Unknowns> unknowns, RobustMode robust) const;
  NoiseSlope noise_slopes() const;
  void maximise();
  bool fit_noise();
  void fit_with_noise();
  bool innovations_are_independent() const;
  void widen_uncertain_slip();
  void require_plausible() const;

  const std::vector<PreparedRun>& runs_;
  WheelFactors loaded_;
  std::vector<Unknowns> unknowns_;
  FixedParameters fixed_;
  NoiseModel noise_;
  RobustMode robust_ = RobustMode::none;
  int stride_ = 1;
  int phases_ = 1;  // passes along each run, each beginning at another sample
  std::vector<InnovationSums> sums_;
  int iterations_ = 0;
};

}  // namespace astro::calibration
