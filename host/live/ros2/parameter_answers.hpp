#pragma once

#include <functional>
#include <span>

#include "host/formats/messages/parameters.hpp"
#include "host/live/driver/parameter_table.hpp"

namespace astro::live {

/// Answers requests for a node's parameters as nodes of rclcpp do: if one of the requested names is unknown, the answer is
/// empty.
///
/// Source  rclcpp: parameter_service.cpp, node_interfaces/node_parameters.cpp.
class ParameterAnswers {
 public:
  /// Called with the parameters that one set has changed, and with their new values.
  using OnChange = std::function<void(std::span<const ros2::msg::Parameter>)>;

  /// `table` must outlive it.
  ParameterAnswers(ParameterTable& table, OnChange on_change);

  ros2::msg::GetParameters::Response to(const ros2::msg::GetParameters::Request& request) const;
  ros2::msg::GetParameterTypes::Response to(const ros2::msg::GetParameterTypes::Request& request) const;
  ros2::msg::DescribeParameters::Response to(const ros2::msg::DescribeParameters::Request& request) const;
  /// The names below the prefixes, at most `depth` words further down (0: any). Words are divided by dots.
  ros2::msg::ListParameters::Response to(const ros2::msg::ListParameters::Request& request) const;
  /// If one parameter is refused, the others are still set.
  ros2::msg::SetParameters::Response to(const ros2::msg::SetParameters::Request& request);
  ros2::msg::SetParametersAtomically::Response to(const ros2::msg::SetParametersAtomically::Request& request);

 private:
  ros2::msg::SetParametersResult set(std::span<const ros2::msg::Parameter> parameters);

  ParameterTable& table_;
  OnChange on_change_;
};

}  // namespace astro::live
