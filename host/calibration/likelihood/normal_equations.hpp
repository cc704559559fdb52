#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "host/calibration/likelihood/innovation.hpp"

/// The Gauss-Newton step of many runs that share some unknowns and have others of their own.
namespace astro::calibration {

using SharedInformation = Eigen::Matrix<double, kShared, kShared>;
using SharedVector = Eigen::Matrix<double, kShared, 1>;

/// Which unknowns are held where they are.
struct Held {
  bool factors = false;    // c_R, c_L, b
  bool clock = false;      // offsets and skew
  bool lever_yaw = false;  // no headings anywhere
};

/// One run with its own unknowns eliminated (Schur complement).
struct Reduced {
  SharedInformation information;
  SharedVector gradient;
};
Reduced reduced(const InnovationSums& sums, const Held& held, double damping);

/// The steps of all unknowns, one entry per run, its shared part equal in all. `damping`:
/// Levenberg-Marquardt's.
std::vector<Unknowns> gauss_newton_step(std::span<const InnovationSums> sums, const Held& held,
                                        double damping);

/// Of the shared unknowns, from the sum of reduced informations. Whatever the runs do not show at all (the
/// lever arm of lines, the skew of one short run) keeps the wide variance of a weak prior, so that the rest
/// can be told.
SharedInformation shared_covariance(const SharedInformation& information, const Held& held);

/// Logarithm of the determinant of the information about all unknowns together. Added to -2 log likelihood it
/// makes the restricted likelihood, which judges noise without the illusion that the fitted unknowns were
/// known beforehand. Source  Patterson & Thompson 1971, Biometrika 58(3).
double log_determinant(std::span<const InnovationSums> sums, const Held& held);

/// What the runs say about the one unknown outside, kArcWheelbase, when all others give way to it: its value
/// and the standard error, to first order. Infinite error where they say nothing.
struct OneUnknown {
  double value = 0, standard_error = 0;
};
OneUnknown arc_wheelbase(std::span<const InnovationSums> sums, const Held& held);

/// Of the offset of one run's clock, given the covariance of the shared unknowns.
double clock_offset_variance(const InnovationSums& sums, const SharedInformation& covariance,
                             const Held& held);

}  // namespace astro::calibration
