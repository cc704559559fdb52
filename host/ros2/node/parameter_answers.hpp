#pragma once

#include <functional>
#include <span>

#include "host/ros2/messages/parameters.hpp"
#include "host/ros2/middleware/parameter_table.hpp"

namespace astro::ros2 {

/// What a node answers when others ask for its parameters, as nodes of rclcpp do: one unknown name among those that are
/// asked for, and the answer is empty.
///
/// Source  rclcpp: parameter_service.cpp, node_interfaces/node_parameters.cpp.
class ParameterAnswers {
 public:
  /// The parameters that have been changed at once, with the values that they have now.
  using OnChange = std::function<void(std::span<const msg::Parameter>)>;

  /// `table` must outlive it.
  ParameterAnswers(ParameterTable& table, OnChange on_change);

  msg::GetParameters::Response to(const msg::GetParameters::Request& request) const;
  msg::GetParameterTypes::Response to(const msg::GetParameterTypes::Request& request) const;
  msg::DescribeParameters::Response to(const msg::DescribeParameters::Request& request) const;
  /// The names below the prefixes, at most `depth` words further down (0: any). Words are divided by dots.
  msg::ListParameters::Response to(const msg::ListParameters::Request& request) const;
  /// Each alone: one that is refused does not keep others from being set.
  msg::SetParameters::Response to(const msg::SetParameters::Request& request);
  msg::SetParametersAtomically::Response to(const msg::SetParametersAtomically::Request& request);

 private:
  msg::SetParametersResult set(std::span<const msg::Parameter> parameters);

  ParameterTable& table_;
  OnChange on_change_;
};

}  // namespace astro::ros2
