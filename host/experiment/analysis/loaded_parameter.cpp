#include "host/experiment/analysis/loaded_parameter.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/base/error.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/files/number_named.hpp"
#include "host/recording/run_metadata.hpp"

namespace astro::experiment {

double loaded_parameter(const recording::RunInfo& info, const char* parameter, const std::string& file) {
  const std::optional<double> value = number_named(info.parameters, parameter);
  if (value && std::isfinite(*value) && *value > 0) return *value;
  const std::string fact = fmt::format("the recording '{}' does not say which {} was loaded in the robot",
                                       file.empty() ? run_name(info) : file, parameter);
  if (file.empty()) throw Error(fact, AnalysisProblem::run_lacks_parameter, {run_name(info), parameter});
  throw Error(fact, AnalysisProblem::file_lacks_parameter, {file, parameter});
}

}  // namespace astro::experiment
