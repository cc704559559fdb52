#include "host/ros2/foxglove/parameter_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/base/error.hpp"
#include "host/ros2/middleware/parameter_table.hpp"

namespace astro::ros2::foxglove {
namespace {

using nlohmann::json;

msg::ParameterValue value_of(ParameterType type) {
  msg::ParameterValue value;
  value.type = static_cast<std::uint8_t>(type);
  return value;
}

msg::ParameterValue real(double number) {
  msg::ParameterValue value = value_of(ParameterType::real);
  value.double_value = number;
  return value;
}

msg::ParameterValue integer(const json& number) {
  if (number.is_number_unsigned() && number.get<std::uint64_t>() > INT64_MAX)
    throw Error("a whole number does not fit into 64 bits");
  msg::ParameterValue value = value_of(ParameterType::integer);
  value.integer_value = number.get<std::int64_t>();
  return value;
}

}  // namespace

json to_json(const msg::Parameter& parameter) {
  json object{{"name", parameter.name}};
  switch (static_cast<ParameterType>(parameter.value.type)) {
    case ParameterType::boolean:
      object["value"] = parameter.value.bool_value;
      break;
    case ParameterType::integer:
      object["value"] = parameter.value.integer_value;
      break;
    case ParameterType::real:
      if (std::isfinite(parameter.value.double_value)) object["value"] = parameter.value.double_value;
      object["type"] = "float64";
      break;
    case ParameterType::text:
      object["value"] = parameter.value.string_value;
      break;
    default:
      break;
  }
  return object;
}

msg::ParameterValue parameter_value_in(const json& parameter) {
  const auto found = parameter.find("value");
  if (found == parameter.end() || found->is_null()) return value_of(ParameterType::not_set);
  const bool is_real = parameter.contains("type") && parameter["type"] == "float64";
  if (found->is_number_float() || (is_real && found->is_number())) return real(found->get<double>());
  if (found->is_number_integer()) return integer(*found);
  if (found->is_boolean()) {
    msg::ParameterValue value = value_of(ParameterType::boolean);
    value.bool_value = found->get<bool>();
    return value;
  }
  if (!found->is_string())
    throw Error("the value of a parameter is neither a number nor a text nor a truth value");
  msg::ParameterValue value = value_of(ParameterType::text);
  value.string_value = found->get<std::string>();
  return value;
}

}  // namespace astro::ros2::foxglove
