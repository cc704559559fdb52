#pragma once

#include <nlohmann/json.hpp>

#include "host/experiment/analysis/calibration.hpp"

/// The keys under which --json prints results; numbers that do not exist are null.
namespace astro::experiment {

nlohmann::json to_json(const calibration::ExperimentSummary& summary);
nlohmann::json to_json(const calibration::ClusterSummary& cluster);

/// The keys that all methods share (factors, their errors, the loaded factors, squares), and those of the method.
nlohmann::json to_json(const Calibration& calibration);

/// Null where the value is not finite: JSON has no NaN.
nlohmann::json number(double value);

}  // namespace astro::experiment
