#pragma once

#include <vector>

#include "host/base/remedy.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"

namespace astro::calibration {

/// One sentence for each thing that does not fit about an estimate; empty if everything fits.
std::vector<Remark> remarks(const MlEstimate& estimate);

}  // namespace astro::calibration
