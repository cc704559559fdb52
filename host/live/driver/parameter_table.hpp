#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "host/formats/messages/parameters.hpp"

namespace astro::live {

/// As rcl_interfaces/msg/ParameterType numbers them.
enum class ParameterType : std::uint8_t { not_set = 0, boolean = 1, integer = 2, real = 3, text = 4 };

/// A node's parameters as ROS 2 shows them, wherever they come from. Only set() may wait.
class ParameterTable {
 public:
  ParameterTable() = default;
  ParameterTable(const ParameterTable&) = delete;
  ParameterTable& operator=(const ParameterTable&) = delete;
  virtual ~ParameterTable() = default;

  /// Whether the values are recent enough to be given out. If not, they are being read again. Requests to read or set
  /// parameters then have to wait without blocking this thread, because a stop must not wait for a table.
  virtual bool is_fresh() { return true; }
  /// The parameters' names, types, ranges and meanings; empty while they are not known.
  virtual std::vector<ros2::msg::ParameterDescriptor> descriptors() = 0;
  /// Nothing if there is no such parameter.
  virtual std::optional<ros2::msg::ParameterValue> value(std::string_view name) = 0;
  /// Sets all of them or none. The reason for a refusal names the parameter.
  virtual ros2::msg::SetParametersResult set(std::span<const ros2::msg::Parameter> parameters) = 0;
};

}  // namespace astro::live
