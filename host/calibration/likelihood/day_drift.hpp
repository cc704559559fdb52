#pragma once

#include <span>

#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/likelihood/normal_equations.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// How much the factors of a robot change from one day to another: tyres, load, floor and temperature are others.
namespace astro::calibration {

/// Standard deviations of the difference between two days: of E_d = c_R / c_L, of S = (c_R + c_L) / 2 and of b / S, relative, and of e,
/// which change independently. The defaults are those of real robots: one had an E_d of 0.99892 and ten days later of 0.99946; S and
/// b / S change less, and 3e-4 is an assumption. No change of e was seen, and no e is known better than to 0.003.
struct DayDrift {
  double E_d = 5e-4, scale = 3e-4, b_over_scale = 3e-4, e = 3e-3;
  /// From the spread of how many sessions it was estimated; with fewer than two it is the default.
  int sessions = 1;

  /// Of factors that are off by errors like these.
  FactorMatrix covariance(const WheelFactors& factors) const;
};

/// From the spread between the sessions of `drives` beyond what their noise explains; the defaults count like four sessions more, because
/// two alone say little. The noise is not widened (MlEstimate::widening), because runs of different days scatter for this very reason.
DayDrift drift_between_sessions(std::span<const InnovationSums> drives, const FixedParameters& fixed,
                                const PriorOfE& prior, const WheelFactors& factors);

/// The covariance of the factors found less those of another day: the drives' own noise, what the days of these drives differ by
/// from the mean of all days, and what the other day does.
FactorMatrix covariance_on_another_day(std::span<const InnovationSums> drives, const FixedParameters& fixed,
                                       const PriorOfE& prior, const WheelFactors& factors,
                                       const FactorMatrix& own, const DayDrift& drift);

}  // namespace astro::calibration
