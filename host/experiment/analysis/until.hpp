#pragma once

#include <string>

#include "host/calibration/judgement/precision.hpp"
#include "host/experiment/analysis/calibration.hpp"

/// Driving until it is enough: how precise a calibration is.
namespace astro::experiment {

/// Standard errors over values; NaN where the method cannot tell.
calibration::Precision precision_of(const Calibration& calibration);

/// All three are known and at most `target`.
bool reaches(const calibration::Precision& precision, double target);

/// "E_d ± 0.042 %, S ± 0.021 %, b ± 0.110 %"
std::string described(const calibration::Precision& precision);

}  // namespace astro::experiment
