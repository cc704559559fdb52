#pragma once

#include <span>

#include "host/calibration/likelihood/normal_equations.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/preparation/preparation.hpp"

namespace astro::calibration {

/// The covariance that the factors would have if all unknowns of the runs were at given values: the Cramer-Rao bound.
class ExpectedBound {
 public:
  /// `runs` is only asked whether any of them has headings.
  ExpectedBound(std::span<const PreparedRun> runs, const WheelFactors& factors, const LeverArm& lever,
                const NoiseModel& noise, bool clock_known, double spacing_m);

  void add(const PreparedRun& run, const ClockFit& clock);
  /// With the runs that were added. Each further one can only lessen it.
  FactorMatrix covariance() const { return pool_.factor_covariance(); }

 private:
  const WheelFactors factors_;
  const LeverArm lever_;
  const NoiseModel noise_;
  const double spacing_m_;
  const FixedParameters fixed_;
  Pool pool_;
};

}  // namespace astro::calibration
