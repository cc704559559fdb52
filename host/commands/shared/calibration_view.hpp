#pragma once

#include <string>

#include "host/experiment/analysis/calibration.hpp"

namespace astro::commands {

/// A calibration as a person reads it, at most 80 columns wide.
std::string calibration_text(const experiment::Calibration& calibration);

/// What a person should know before the factors are loaded: how they were found, how precisely, and what does
/// not fit.
std::string calibration_summary(const experiment::Calibration& calibration);

}  // namespace astro::commands
