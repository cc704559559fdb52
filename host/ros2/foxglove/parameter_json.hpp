#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/ros2/messages/parameters.hpp"

/// Parameters as viewers write them: {"name": "c_R", "value": 1.002, "type": "float64"}.
namespace astro::ros2::foxglove {

/// Of the types that host/ros2/middleware/parameter_table.hpp knows; a parameter that is not set, or not of one of them, has no
/// "value". "type" marks a real number, which JSON cannot tell from a whole one.
nlohmann::json to_json(const msg::Parameter& parameter);

/// The value of such an object. No "value", or null: not set. Throws astro::Error for a list, an object, and a number that does not
/// fit into 64 bits.
msg::ParameterValue parameter_value_in(const nlohmann::json& parameter);

}  // namespace astro::ros2::foxglove
