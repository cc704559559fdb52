#pragma once

#include "host/calibration/likelihood/normal_equations.hpp"

/// The factors without some of the runs, as far as the other runs determine them.
namespace astro::calibration {

/// The information of all runs is divided into directions in the space of the factors, in each of which the held-out runs and
/// the others determine the factors independently. Where nearly all information is in the held-out runs, the other runs cannot
/// predict them: of two circles, one each way, either shows the sum or the difference of what E_d and b do, and nothing of
/// what the other shows. Such a direction stays as in use, so that it counts neither for nor against new factors.
struct HeldOutFactors {
  FactorVector change =
      FactorVector::Zero();  // from the factors in use to those that the other runs determine
  int undetermined = 0;      // directions that the other runs do not determine
  /// By how much -2 log likelihood of the held-out runs falls from the factors in use to those of all runs, in the determined
  /// directions and in the others.
  double judged = 0, not_judged = 0;
};

/// `change`: from the factors in use to those of all runs, at which the gradients of both pools were taken.
HeldOutFactors held_out_factors(const Pool& all, const Pool& others, const FactorVector& change);

}  // namespace astro::calibration
