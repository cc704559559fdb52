#pragma once

#include <string>

#include "host/calibration/judgement/precision.hpp"
#include "host/experiment/analysis/calibration.hpp"

/// The precision of a calibration, for driving until it is sufficient.
namespace astro::experiment {

/// Standard errors of the drives themselves over values, without that of the ground truth's scale, because driving on makes no others
/// smaller; NaN if the method does not determine them. Precondition: no loaded S counts beside that of scans.
calibration::Precision precision_of(const Calibration& calibration);

/// All three are known and at most `target`.
bool reaches(const calibration::Precision& precision, double target);

/// "E_d ± 0.042 %, S ± 0.021 %, b ± 0.110 %"
std::string described(const calibration::Precision& precision);

}  // namespace astro::experiment
