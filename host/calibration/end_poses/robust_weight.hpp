#pragma once

#include <vector>

/// Weights and scatter for fits that a few wrong numbers must not spoil.
namespace astro::calibration {

/// Numbers of one run that belong together.
struct Distance {
  double square = 0;  // from where the fit expects them, in terms of their covariance
  double count = 1;   // how many they are
};

/// The variance of a fit with robust_weight over that of least squares where the scatter is normal.
inline constexpr double kLossOfNormal = 1.08;

/// How much the fit listens to these numbers: 1 or a little more where they fit, less the farther they are. These are the
/// weights of Student's t distribution of six degrees of freedom, narrowed so that for normal numbers it is the closest one.
///
/// Source  Lange, Little & Taylor 1989, Robust statistical modeling using the t distribution.
double robust_weight(const Distance& distance, double scatter);

/// The variance of the numbers over what their covariance says, from the median of the distances, so that nearly half of
/// them may be wrong. `fitted`: how many numbers the fit matches exactly. Something is known before any run, worth four
/// numbers, so that two runs which happen to agree do not seem exact: the result is 1 where there are no numbers.
double robust_scatter(const std::vector<Distance>& distances, double fitted);

}  // namespace astro::calibration
