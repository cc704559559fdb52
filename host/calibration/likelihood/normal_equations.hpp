#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "host/calibration/likelihood/innovation.hpp"

/// The Gauss-Newton step of several runs that share some unknowns and have others of their own.
namespace astro::calibration {

using SharedInformation = Eigen::Matrix<double, kShared, kShared>;
using SharedVector = Eigen::Matrix<double, kShared, 1>;

/// Which unknowns are not estimated.
struct FixedParameters {
  bool factors = false;    // c_R, c_L, b
  bool clock = false;      // offsets and skew
  bool lever_yaw = false;  // no headings anywhere
};

/// One run with its own unknowns eliminated (Schur complement).
struct Reduced {
  SharedInformation information;
  SharedVector gradient;
};
Reduced reduced(const InnovationSums& sums, const FixedParameters& fixed, double damping);

/// The steps of all unknowns, one entry per run; the shared part is equal in all. `damping` is that of
/// Levenberg and Marquardt.
std::vector<Unknowns> gauss_newton_step(std::span<const InnovationSums> sums, const FixedParameters& fixed,
                                        double damping);

/// Covariance of the shared unknowns from the sum of the reduced informations. An unknown that the runs do not
/// observe (the lever arm in lines, the skew in one short run) keeps the wide variance of a weak prior, so that
/// the others can be determined.
SharedInformation shared_covariance(const SharedInformation& information, const FixedParameters& fixed);

/// Logarithm of the determinant of the information about all unknowns together. Added to -2 log likelihood it
/// gives that of the restricted likelihood, which allows for the fitted unknowns when noise is estimated. Source  Patterson & Thompson 1971, Biometrika 58(3).
double log_determinant(std::span<const InnovationSums> sums, const FixedParameters& fixed);

/// The estimate of kArcWheelbase to first order, with all other unknowns fitted beside it. The standard error is
/// infinite if the runs do not observe it.
struct OneUnknown {
  double value = 0, standard_error = 0;
};
OneUnknown arc_wheelbase(std::span<const InnovationSums> sums, const FixedParameters& fixed);

/// Variance of one run's clock offset, given the covariance of the shared unknowns.
double clock_offset_variance(const InnovationSums& sums, const SharedInformation& covariance,
                             const FixedParameters& fixed);

}  // namespace astro::calibration
