#include "host/live/foxglove/parameter_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/base/error.hpp"
#include "host/live/driver/parameter_table.hpp"
#include "host/live/foxglove/client_messages.hpp"

namespace astro::foxglove {
namespace {

using nlohmann::json;

ros2::msg::ParameterValue value_of(live::ParameterType type) {
  ros2::msg::ParameterValue value;
  value.type = static_cast<std::uint8_t>(type);
  return value;
}

ros2::msg::ParameterValue real(double number) {
  ros2::msg::ParameterValue value = value_of(live::ParameterType::real);
  value.double_value = number;
  return value;
}

ros2::msg::ParameterValue integer(const json& number) {
  if (number.is_number_unsigned() && number.get<std::uint64_t>() > INT64_MAX)
    throw Error("a whole number does not fit into 64 bits", MessageProblem::beyond_64_bits);
  ros2::msg::ParameterValue value = value_of(live::ParameterType::integer);
  value.integer_value = number.get<std::int64_t>();
  return value;
}

}  // namespace

json to_json(const ros2::msg::Parameter& parameter) {
  json object{{"name", parameter.name}};
  switch (static_cast<live::ParameterType>(parameter.value.type)) {
    case live::ParameterType::boolean:
      object["value"] = parameter.value.bool_value;
      break;
    case live::ParameterType::integer:
      object["value"] = parameter.value.integer_value;
      break;
    case live::ParameterType::real:
      if (std::isfinite(parameter.value.double_value)) object["value"] = parameter.value.double_value;
      object["type"] = "float64";
      break;
    case live::ParameterType::text:
      object["value"] = parameter.value.string_value;
      break;
    default:
      break;
  }
  return object;
}

ros2::msg::ParameterValue parameter_value_in(const json& parameter) {
  const auto found = parameter.find("value");
  if (found == parameter.end() || found->is_null()) return value_of(live::ParameterType::not_set);
  const bool is_real = parameter.contains("type") && parameter["type"] == "float64";
  if (found->is_number_float() || (is_real && found->is_number())) return real(found->get<double>());
  if (found->is_number_integer()) return integer(*found);
  if (found->is_boolean()) {
    ros2::msg::ParameterValue value = value_of(live::ParameterType::boolean);
    value.bool_value = found->get<bool>();
    return value;
  }
  if (!found->is_string())
    throw Error("the value of a parameter is neither a number nor a text nor a truth value",
                MessageProblem::no_parameter_value);
  ros2::msg::ParameterValue value = value_of(live::ParameterType::text);
  value.string_value = found->get<std::string>();
  return value;
}

}  // namespace astro::foxglove
