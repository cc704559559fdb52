#include "host/experiment/files/factors_json.hpp"

#include <nlohmann/json.hpp>

namespace astro::experiment {

nlohmann::json to_json(const calibration::WheelFactors& factors) {
  return {{"c_R", factors.c_r},
          {"c_L", factors.c_l},
          {"b_m", factors.b_m},
          {"e", factors.e},
          {"kappa0", factors.kappa0}};
}

calibration::WheelFactors factors_in(const nlohmann::json& json) {
  calibration::WheelFactors factors{json.at("c_R"), json.at("c_L"), json.at("b_m")};
  factors.e = json.value("e", factors.e);
  factors.kappa0 = json.value("kappa0", factors.kappa0);
  return factors;
}

}  // namespace astro::experiment
