#pragma once

#include <nlohmann/json.hpp>

#include "host/experiment/analysis/calibration.hpp"

namespace astro::experiment {

/// The keys of maximum likelihood alone: covariance, lever arm, clock, noise, runs, motions, remarks.
nlohmann::json to_json(const MlResult& ml);

}  // namespace astro::experiment
