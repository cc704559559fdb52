#pragma once

#include <span>
#include <vector>

#include "host/calibration/likelihood/normal_equations.hpp"

/// Whether each run agrees with all others about the factors.
namespace astro::calibration {

/// d' C^-1 d for the change d of the factors when the run is left out, with its covariance C. It has a
/// chi-square distribution with `degrees_of_freedom` if the run is like the others.
struct Disagreement {
  double chi_square = 0;
  int degrees_of_freedom = 0;  // 0: nothing to compare, or the others alone do not observe a factor
};
std::vector<Disagreement> disagreements(std::span<const Reduced> runs, const FixedParameters& fixed);

/// Birge's ratio of all runs: how much more they scatter than their noise explains, as a factor on variances;
/// 1 if that is not significant (1 %). Source  Birge 1932, Phys. Rev. 40, 207.
double dispersion(std::span<const Disagreement> runs);

/// The same ratio as a median, which a few deviating runs do not change; at least 1.
double typical_dispersion(std::span<const Disagreement> runs);

/// Probability that a chi-square variable with `degrees_of_freedom` exceeds `value`; 1 for 0 degrees. Exact up to 3, Wilson and
/// Hilferty's approximation above.
double chi_square_tail(double value, int degrees_of_freedom);

}  // namespace astro::calibration
