#pragma once

#include <vector>

#include "host/base/remedy.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"

namespace astro::calibration {

/// What does not fit about an estimate, in plain words; empty if everything does.
std::vector<Remark> remarks(const MlEstimate& estimate);

}  // namespace astro::calibration
