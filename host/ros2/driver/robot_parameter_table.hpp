#pragma once

#include <concepts>
#include <functional>
#include <string>
#include <vector>

#include "host/ros2/driver/robot_session.hpp"
#include "host/ros2/middleware/parameter_table.hpp"

namespace astro::ros2 {

/// A parameter of the node itself, for all to read.
struct FixedParameter {
  std::string name, doc;
  msg::ParameterValue value;
};

/// The robot's parameters as parameters of the node, with their ranges and units, and a few of the node that nobody can change.
/// A set is staged, committed to the robot's flash as a whole, and read back; the robot refuses it while it drives. While there
/// is no robot, only the node's own are there.
class RobotParameterTable : public ParameterTable {
 public:
  /// The session now, or null.
  using Session = std::function<RobotSession*()>;
  /// Whether the robot is in use, so that its link has no time for a table of values that nobody can change meanwhile.
  using Busy = std::function<bool()>;

  /// `changed` is called after values were put in force; `lost` if the link is lost meanwhile.
  RobotParameterTable(Session session, Busy busy, std::vector<FixedParameter> fixed,
                      std::function<void(RobotSession&)> changed, std::function<void(const Error&)> lost)
      : session_(std::move(session)),
        busy_(std::move(busy)),
        fixed_(std::move(fixed)),
        changed_(std::move(changed)),
        lost_(std::move(lost)) {}

  std::vector<msg::ParameterDescriptor> descriptors() override;
  std::optional<msg::ParameterValue> value(std::string_view name) override;
  msg::SetParametersResult set(std::span<const msg::Parameter> parameters) override;

 private:
  void refresh(RobotSession& session);
  void put_in_force(RobotSession& session, std::span<const msg::Parameter> parameters);
  const FixedParameter* fixed(std::string_view name) const;

  Session session_;
  Busy busy_;
  std::vector<FixedParameter> fixed_;
  std::function<void(RobotSession&)> changed_;
  std::function<void(const Error&)> lost_;
  const RobotSession* of_ = nullptr;  // whose values were read ...
  microseconds read_at_{};            // ... and when
};

msg::ParameterValue to_parameter(double value);
/// Takes no number for a flag.
msg::ParameterValue to_parameter(std::same_as<bool> auto value) {
  msg::ParameterValue parameter;
  parameter.type = static_cast<std::uint8_t>(ParameterType::boolean);
  parameter.bool_value = value;
  return parameter;
}
msg::ParameterValue to_parameter(const std::string& value);

}  // namespace astro::ros2
