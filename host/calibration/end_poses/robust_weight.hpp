#pragma once

#include <vector>

/// Weights and scatter for fits that are robust against a few wrong numbers.
namespace astro::calibration {

/// Numbers of one run that belong together.
struct Distance {
  double square = 0;  // from where the fit expects them, in terms of their covariance
  double count = 1;   // how many they are
};

/// The variance of a fit with robust_weight over that of least squares where the scatter is normal.
inline constexpr double kLossOfNormal = 1.08;

/// The weight of these numbers in a fit: 1 or a little more if they fit, and less the farther off they are. These are the
/// weights of Student's t distribution of six degrees of freedom, scaled so that it comes closest to a normal one.
///
/// Source  Lange, Little & Taylor 1989, Robust statistical modeling using the t distribution.
double robust_weight(const Distance& distance, double scatter);

/// The ratio of the numbers' variance to their covariance, from the median of the distances, so that nearly half of them may be
/// wrong. `fitted`: degrees of freedom that the fit uses up. A prior of 1 with the weight of four numbers keeps two runs that
/// happen to agree from seeming exact. Without numbers the result is 1.
double robust_scatter(const std::vector<Distance>& distances, double fitted);

/// The same ratio for standard errors, in which a scatter that is itself known badly counts, too: with it, errors over standard
/// errors have a mean square of 1, and not only a median. From the mean of the weighted squares, which ten runs show better than
/// their median. The prior of 1 only raises it: four numbers do not keep a robot that slips more from being known as such.
double scatter_for_errors(const std::vector<Distance>& distances, double scatter, double fitted);

}  // namespace astro::calibration
