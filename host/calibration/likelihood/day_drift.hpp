#pragma once

#include <span>
#include <vector>

#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/likelihood/normal_equations.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/prepared_run.hpp"

/// How much the factors of a robot change from one day to another: tyres, load, floor and temperature are others.
namespace astro::calibration {

/// The order of ratios_by_factors.
enum Ratio { kRatio, kScale, kBaseOverScale, kRatioE };

/// Relative changes of E_d, S and b / S, and the change of e, by those of the factors.
FactorMatrix ratios_by_factors(const WheelFactors& factors);

/// Standard deviations of the difference between two days: of E_d = c_R / c_L, of S = (c_R + c_L) / 2 and of b / S, relative, and of
/// e. All four change independently. The defaults are those of real robots: one had an E_d of 0.99892 and ten days later of 0.99946; S and
/// b / S change less, and 3e-4 is an assumption. No change of e was seen, and no e is known better than to 0.003.
struct DayDrift {
  double E_d = 5e-4, scale = 3e-4, b_over_scale = 3e-4, e = 3e-3;
  /// From the spread of how many days E_d, S and b / S were estimated; with fewer than two they are the defaults. e always is.
  int days = 0;

  /// Of factors that are off by errors like these.
  FactorMatrix covariance(const WheelFactors& factors) const;
};

/// The day of each run, from 0: drives before and after a night are of two days. Sessions are no days, because a body is also mounted
/// anew, and a folder or a clock begun, in the middle of one. All runs are of one day unless the dates of all are known.
std::vector<int> find_days(std::span<const PreparedRun> runs);

/// From the spread between the days of `drives` beyond what their noise explains. The defaults count like four days more, because
/// two days alone say little. A day that leaves one of the ratios open does not count. The noise is not widened
/// (MlEstimate::widening), because runs of different days scatter for this very reason.
DayDrift drift_between_days(std::span<const InnovationSums> drives, std::span<const int> days,
                            const FixedParameters& fixed, const PriorOfE& prior, const WheelFactors& factors);

/// The covariance of the factors found minus those of another day. It has three parts: the drives' own noise, how far the days of
/// these drives are off the mean of all days, and how far the other day is.
FactorMatrix covariance_on_another_day(std::span<const InnovationSums> drives, std::span<const int> days,
                                       const FixedParameters& fixed, const PriorOfE& prior,
                                       const WheelFactors& factors, const FactorMatrix& own,
                                       const DayDrift& drift);

}  // namespace astro::calibration
