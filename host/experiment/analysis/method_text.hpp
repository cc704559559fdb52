#pragma once

#include <string>

#include "host/experiment/analysis/calibration.hpp"

namespace astro::experiment {

/// How the factors were found, for a report: paragraphs with a blank line between them.
std::string method_text(const Calibration& calibration);

}  // namespace astro::experiment
