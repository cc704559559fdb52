#include "host/experiment/analysis/dead_reckoning.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/files/curvature_named.hpp"
#include "host/experiment/files/number_named.hpp"

namespace astro::experiment {
namespace {

double factor(const ParameterFile& file, const std::filesystem::path& path, const char* name) {
  const std::optional<double> value = number_named(file.parameters, name);
  if (!value)
    throw Error(fmt::format("{} has no {} under [parameters]", path.string(), name),
                AnalysisProblem::no_calibration, {name, path.string()});
  return *value;
}

}  // namespace

NamedFactors factors_of_file(const std::filesystem::path& path, const NominalWheel& wheel) {
  const ParameterFile file = read_parameter_file(path);
  if (file.wheel && !wheel.measures_like(*file.wheel))
    throw Error(
        fmt::format(
            "{} is for {}, the drives were recorded with {}: its c_R and c_L mean another thing there",
            path.string(), file.wheel->described(), wheel.described()),
        AnalysisProblem::factors_of_other_wheel, {path.string()});
  const NamedFactors found{
      path.string(),
      with_curvature_named({factor(file, path, "c_R"), factor(file, path, "c_L"), factor(file, path, "b")},
                           file.parameters, path.string()),
      file.robot};
  if (!(found.factors.b_m > 0.01 && found.factors.b_m < 10))
    throw Error(fmt::format("{} has b = {:.4g} m, which no robot has: correct or replace it", path.string(),
                            found.factors.b_m));
  for (const double ratio : {found.factors.c_r, found.factors.c_l})
    if (!(ratio > 0.5 && ratio < 2))
      throw Error(
          fmt::format("{} has c_R = {:.4g} and c_L = {:.4g}, which no wheel has: correct or replace it",
                      path.string(), found.factors.c_r, found.factors.c_l));
  return found;
}

std::vector<DeadReckoning> dead_reckon(const RunSet& set, std::span<const NamedFactors> factors,
                                       MlChoice::Clock clock) {
  const std::vector<calibration::Trajectory> runs = trajectories_of(set);
  calibration::MlOptions options;
  options.clock_known = clock_known(set, clock);
  std::vector<DeadReckoning> all;
  for (const NamedFactors& by : factors)
    all.push_back({by, calibration::path_errors(runs, by.factors, options)});
  return all;
}

}  // namespace astro::experiment
