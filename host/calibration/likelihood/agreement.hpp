#pragma once

#include <span>
#include <vector>

#include "host/calibration/likelihood/normal_equations.hpp"

/// Whether each run agrees with all others about c_R, c_L and b.
namespace astro::calibration {

/// d' C^-1 d of the change d that leaving the run out makes, with C its covariance: chi-square of
/// `degrees_of_freedom` if the run is like the others.
struct Disagreement {
  double chi_square = 0;
  int degrees_of_freedom = 0;  // 0: nothing to compare, or the others alone would leave a factor open
};
std::vector<Disagreement> disagreements(std::span<const Reduced> runs, const Held& held);

/// Birge's ratio of them all: how much more the runs scatter than their noise explains, as a factor on
/// variances. 1 where they do not do so significantly (1 %). Source  Birge 1932, Phys. Rev. 40, 207.
double dispersion(std::span<const Disagreement> runs);

/// The same ratio of most runs, whatever a few of them did; at least 1.
double typical_dispersion(std::span<const Disagreement> runs);

/// Probability of a chi-square of `degrees_of_freedom` beyond `value`; 1 for 0. Exact up to 3, Wilson and
/// Hilferty's approximation above.
double chi_square_tail(double value, int degrees_of_freedom);

}  // namespace astro::calibration
