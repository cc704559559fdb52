#pragma once

#include <nlohmann/json.hpp>

#include "host/calibration/umbmark.hpp"

/// The keys under which --json prints results; numbers that do not exist are null.
namespace astro::experiment {

nlohmann::json to_json(const calibration::ExperimentSummary& summary);
nlohmann::json to_json(const calibration::ClusterSummary& cluster);
nlohmann::json to_json(const calibration::Estimate& estimate);

/// Null where the value is not finite: JSON has no NaN.
nlohmann::json number(double value);

}  // namespace astro::experiment
