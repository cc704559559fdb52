#pragma once

#include <map>
#include <string>

#include "host/live/driver/parameter_table.hpp"

namespace astro::live {

inline ros2::msg::ParameterValue real(double value) {
  ros2::msg::ParameterValue result;
  result.type = static_cast<std::uint8_t>(ParameterType::real);
  result.double_value = value;
  return result;
}

/// Numbers up to a million, kept as floats are: what is read back is not to the bit what was set.
class NumbersTable : public ParameterTable {
 public:
  explicit NumbersTable(std::map<std::string, double, std::less<>> values) : values_(std::move(values)) {}

  std::vector<ros2::msg::ParameterDescriptor> descriptors() override {
    std::vector<ros2::msg::ParameterDescriptor> all;
    for (const auto& [name, value] : values_) {
      all.emplace_back().name = name;
      all.back().type = static_cast<std::uint8_t>(ParameterType::real);
      all.back().description = "the number " + name;
      all.back().floating_point_range = {0, 1e6, 0};
    }
    return all;
  }
  std::optional<ros2::msg::ParameterValue> value(std::string_view name) override {
    const auto found = values_.find(name);
    if (found == values_.end()) return std::nullopt;
    return real(found->second);
  }
  ros2::msg::SetParametersResult set(std::span<const ros2::msg::Parameter> parameters) override {
    ++sets;
    for (const ros2::msg::Parameter& each : parameters)
      if (!values_.contains(each.name) || !(each.value.double_value <= 1e6))
        return {false, "the parameter '" + each.name + "' is refused"};
    for (const ros2::msg::Parameter& each : parameters)
      values_[each.name] = static_cast<float>(each.value.double_value);
    return {true, ""};
  }

  int sets = 0;  // how often one was tried

 private:
  std::map<std::string, double, std::less<>> values_;
};

}  // namespace astro::live
