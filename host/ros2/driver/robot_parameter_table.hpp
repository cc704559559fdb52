#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/ros2/driver/robot_session.hpp"
#include "host/ros2/middleware/parameter_table.hpp"

namespace astro::ros2 {

/// A parameter of the node itself, for all to read.
struct OwnParameter {
  std::string name, doc;
  msg::ParameterValue value;
  /// Called with another value of the same type once it is set; nothing: nobody can set it.
  std::function<void(const msg::ParameterValue&)> on_set = {};
};

/// The robot's parameters as parameters of the node, with their ranges and units, and a few of the node.
/// A set is staged, committed to the robot's flash as a whole, and read back; the robot refuses it while it drives, and a value
/// that a person would have to confirm (host/robot/parameters/far_change.hpp) is refused here. While there is no robot, only the
/// node's own are there.
class RobotParameterTable : public ParameterTable {
 public:
  /// The session now, or null.
  using Session = std::function<RobotSession*()>;
  /// Whether the robot is in use, so that its link has no time for a table of values that nobody can change meanwhile.
  using Busy = std::function<bool()>;

  /// `changed` is called after values were put in force; `lost` if the link is lost meanwhile; `words` puts a refusal into words.
  RobotParameterTable(Session session, Busy busy, std::vector<OwnParameter> own,
                      std::function<void(RobotSession&)> changed, std::function<void(const Error&)> lost,
                      std::function<std::string(const Error&)> words)
      : session_(std::move(session)),
        busy_(std::move(busy)),
        own_(std::move(own)),
        changed_(std::move(changed)),
        lost_(std::move(lost)),
        words_(std::move(words)) {}

  std::vector<msg::ParameterDescriptor> descriptors() override;
  std::optional<msg::ParameterValue> value(std::string_view name) override;
  msg::SetParametersResult set(std::span<const msg::Parameter> parameters) override;

  /// A session begins, whose values have just been read.
  void begin(const RobotSession& session, microseconds now) {
    of_ = &session;
    read_at_ = now;
  }
  /// Sets those that the robot has and that differ. "" if they are in force, otherwise why not.
  std::string put_at_start(std::span<const msg::Parameter> parameters);

 private:
  void refresh(RobotSession& session);
  void put_in_force(RobotSession& session, std::span<const msg::Parameter> parameters);
  OwnParameter* own(std::string_view name);
  std::string why_not_own(const msg::Parameter& wanted);
  std::string why_not_robots(std::span<const msg::Parameter> parameters);

  Session session_;
  Busy busy_;
  std::vector<OwnParameter> own_;
  std::function<void(RobotSession&)> changed_;
  std::function<void(const Error&)> lost_;
  std::function<std::string(const Error&)> words_;
  const RobotSession* of_ = nullptr;  // whose values were read ...
  microseconds read_at_{};            // ... and when
};

msg::ParameterValue to_flag(bool value);
msg::ParameterValue to_parameter(double value);
msg::ParameterValue to_parameter(const std::string& value);

}  // namespace astro::ros2
