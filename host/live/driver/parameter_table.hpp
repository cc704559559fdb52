#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "host/formats/messages/parameters.hpp"

namespace astro::live {

/// As rcl_interfaces/msg/ParameterType numbers them.
enum class ParameterType : std::uint8_t { not_set = 0, boolean = 1, integer = 2, real = 3, text = 4 };

/// The parameters of a node, as ROS 2 shows them, whatever stands behind them. Nothing of it waits but set().
class ParameterTable {
 public:
  ParameterTable() = default;
  ParameterTable(const ParameterTable&) = delete;
  ParameterTable& operator=(const ParameterTable&) = delete;
  virtual ~ParameterTable() = default;

  /// Whether values are as new as anybody may expect. If not, they are being read, and whoever wants to know or to set one
  /// waits without keeping this thread: a stop must not wait for a table.
  virtual bool is_fresh() { return true; }
  /// Names, types, ranges and what they mean; empty while they are not known.
  virtual std::vector<ros2::msg::ParameterDescriptor> descriptors() = 0;
  /// Nothing if there is no such parameter.
  virtual std::optional<ros2::msg::ParameterValue> value(std::string_view name) = 0;
  /// All of them or none. The reason of a refusal names the parameter.
  virtual ros2::msg::SetParametersResult set(std::span<const ros2::msg::Parameter> parameters) = 0;
};

}  // namespace astro::live
