#pragma once

#include <span>
#include <vector>

#include "host/calibration/normal_equations.hpp"

/// Whether each run agrees with all others about c_R, c_L and b.
namespace astro::calibration {

/// d' C^-1 d of the change d that leaving the run out makes, with C its covariance: chi-square of
/// `degrees_of_freedom` if the run is like the others.
struct Disagreement {
  double chi_square = 0;
  int degrees_of_freedom = 0;  // 0: nothing to compare, or the others alone would leave a factor open
};
std::vector<Disagreement> disagreements(std::span<const Reduced> runs, const Held& held);

/// Probability of a chi-square of `degrees_of_freedom` (0 to 3) beyond `value`.
double chi_square_tail(double value, int degrees_of_freedom);

}  // namespace astro::calibration
