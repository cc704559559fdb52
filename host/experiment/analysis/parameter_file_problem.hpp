#pragma once

namespace astro::experiment {

/// What is wrong with a file of parameters. Values: the file and, for value_of_other_type, the parameter.
enum class ParameterFileProblem { no_parameters, value_of_other_type, bad_wheel, bad_covariance, bad_slip };

}  // namespace astro::experiment
