#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/calibration/motion/wheel_factors.hpp"

/// Wheel factors under the keys of every JSON that this program writes: "c_R", "c_L", "b_m", "e", "kappa0".
namespace astro::experiment {

nlohmann::json to_json(const calibration::WheelFactors& factors);

/// Reads the factors back. Older versions have neither e nor kappa0: then e is 0. Throws nlohmann::json::exception for
/// another key that is missing, or a value that is no number.
calibration::WheelFactors factors_in(const nlohmann::json& json);

}  // namespace astro::experiment
