#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/formats/messages/parameters.hpp"

/// Parameters as viewers write them: {"name": "c_R", "value": 1.002, "type": "float64"}.
namespace astro::foxglove {

/// A parameter that is not set, or has none of the types that host/live/driver/parameter_table.hpp knows, gets no "value".
/// "type" marks a real number, which JSON cannot tell from a whole one.
nlohmann::json to_json(const ros2::msg::Parameter& parameter);

/// The value of such an object. Without a "value", or if it is null, the parameter is not set. Throws astro::Error for a
/// list, an object, and a number that does not fit into 64 bits.
ros2::msg::ParameterValue parameter_value_in(const nlohmann::json& parameter);

}  // namespace astro::foxglove
