#pragma once

#include <string>

#include "host/recording/run.hpp"

namespace astro::experiment {

/// A parameter that was loaded in the robot while it drove, as the recording has it: finite and positive, because it is a
/// factor, a length or a number of counts. `file`: how the user calls the recording, which the remedy then names; "" if
/// that is not known here.
///
/// Throws astro::Error that names the recording and the parameter.
double loaded_parameter(const recording::RunInfo& info, const char* parameter, const std::string& file = "");

}  // namespace astro::experiment
