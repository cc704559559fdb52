#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/likelihood/ml_fit.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// How well given factors dead-reckon given drives: the test of a calibration on drives that it has not seen.
namespace astro::calibration {

/// Odometry minus truth of one run, in the frame of truth.
struct RunErrors {
  std::string name;
  double final_m = 0,
         final_heading_rad = 0;  // at the last truth sample; heading in [-pi, pi], NaN without headings
  double path_rms_m = 0;         // over all truth samples
};

struct PathErrors {
  std::vector<RunErrors> runs;
  std::vector<Remark> left_out;                       // PreparedRuns::left_out
  double final_rms_m = 0, final_heading_rms_rad = 0;  // over the runs
  double path_rms_m = 0;                              // over all samples of all runs
};

/// The standard error of a root mean square over `count` normal errors about 0: to first order it is 1 / sqrt(2 count) of
/// the value.
double rms_standard_error(double rms, std::size_t count);

/// Dead reckoning by `factors` alone from the start of each run. Lever arm, clocks and start poses are fitted
/// to these runs with the factors fixed.
///
/// Throws astro::Error as estimate_ml does for runs that cannot be used.
PathErrors path_errors(std::span<const Trajectory> runs, const WheelFactors& factors,
                       const MlOptions& options = {});

/// The same with nuisance parameters that were fitted already, while `factors` were fixed.
PathErrors path_errors(const MlFit& fit, const WheelFactors& factors);

/// The mean square of the end errors to be expected of factors that are off by changes of these squares and products (a
/// covariance): of squares of 2 m in both directions, which end beside the start by the error of their heading, and of a line
/// as long. To first order.
double expected_end_error_m2(const FactorCovariance& changes, const WheelFactors& factors);

}  // namespace astro::calibration
