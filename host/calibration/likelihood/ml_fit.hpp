#pragma once

#include <span>
#include <vector>

#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/likelihood/normal_equations.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// The search for the likeliest unknowns.
namespace astro::calibration {

/// Gauss-Newton, damped where it has to be, in turns with the noise where that is not given. Then truth is
/// also thinned until its innovations are independent (whiteness.hpp).
///
/// Throws astro::Error if factors come out that no robot has, and what start_values throws.
class MlFit {
 public:
  /// `prepared` must outlive it. With `factors_held` c_R, c_L and b stay as `carried`, and only the nuisances
  /// give way.
  MlFit(const PreparedRuns& prepared, const WheelFactors& carried, const MlOptions& options,
        bool factors_held = false);

  const std::vector<PreparedRun>& runs() const { return runs_; }
  const std::vector<Unknowns>& unknowns() const { return unknowns_; }  // of each run, their shared part equal
  const std::vector<InnovationSums>& sums() const { return sums_; }
  /// At the same unknowns, with slips counted in full, however unlikely they are: what each run has to say.
  std::vector<InnovationSums> sums_with_wheels_believed() const;
  const NoiseModel& noise() const { return noise_; }
  const Held& held() const { return held_; }
  /// Truth is looked at every so many-th prepared sample; of short runs more often.
  int stride() const { return looks_.stride; }
  int iterations() const { return iterations_; }

 private:
  Looks looks_at(const PreparedRun& run, int phase) const;
  std::vector<InnovationSums> pass(std::span<const Unknowns> unknowns, Doubt doubt) const;
  NoiseSlope noise_slopes() const;
  void maximise();
  bool fit_noise();
  void fit_with_noise();
  bool innovations_are_independent() const;
  void widen_uncertain_slip();
  void require_plausible() const;

  const std::vector<PreparedRun>& runs_;
  WheelFactors carried_;
  std::vector<Unknowns> unknowns_;
  Held held_;
  NoiseModel noise_;
  Looks looks_;
  int phases_ = 1;  // passes along each run, beginning at different samples
  std::vector<InnovationSums> sums_;
  int iterations_ = 0;
};

}  // namespace astro::calibration
