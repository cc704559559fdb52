#pragma once

#include <string>

#include "host/recording/run.hpp"

namespace astro::experiment {

/// A parameter that was loaded in the robot while it drove, as the recording has it: finite and positive,
/// because it is a factor, a length or a number of counts. `file`: how the user calls the recording; "" if
/// that is not known here.
///
/// Throws astro::Error that names the recording and the parameter: AnalysisProblem::file_lacks_parameter, or
/// run_lacks_parameter if the file is not known.
double loaded_parameter(const recording::RunInfo& info, const char* parameter, const std::string& file = "");

}  // namespace astro::experiment
