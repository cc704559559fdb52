#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/live/driver/parameter_table.hpp"
#include "host/live/driver/robot_link.hpp"

namespace astro::live {

/// Values: the assignments, "b=0.3 c_R=1.002".
enum class TableProblem { needs_confirmation };

/// A parameter of the node itself, which everybody may read.
struct OwnParameter {
  std::string name, doc;
  ros2::msg::ParameterValue value;
  /// Called when another value of the same type was set. If it is empty, nobody can set the parameter.
  std::function<void(const ros2::msg::ParameterValue&)> on_set = {};
};

/// The robot's parameters as parameters of the node, with their ranges and units, and a few of the node.
/// A set is staged, committed to the robot's flash as a whole, and read back; the robot refuses it while it drives, and a value
/// that a person would have to confirm (host/robot/parameters/far_change.hpp) is refused here. While there is no robot, or its
/// parameters are not known yet, only the node's own are there.
///
/// Other programs may change the robot's parameters, too. If somebody asks is_fresh() more than a second after the values
/// were read, step() reads them again, a little at a time. While the robot is armed the values are not read again: nobody can
/// change them until it is at rest, and on a slow line reading the whole table takes as long as the robot's own time-out.
class RobotParameterTable : public ParameterTable {
 public:
  /// The session now, or null.
  using Session = std::function<RobotSession*()>;
  /// Whether the robot is in use. Then the link has no time for reading the table, whose values nobody can change meanwhile.
  using Busy = std::function<bool()>;

  /// `changed` is called after values have changed; `lost` if the link is lost in a set; `words` puts a refusal into words.
  /// `meanwhile` is called between the requests of a set, which are many: it may stop the robot, and lose the link.
  RobotParameterTable(Session session, Busy busy, std::vector<OwnParameter> own,
                      std::function<void()> meanwhile, std::function<void(RobotSession&)> changed,
                      std::function<void(const Error&)> lost, std::function<std::string(const Error&)> words)
      : session_(std::move(session)),
        busy_(std::move(busy)),
        own_(std::move(own)),
        meanwhile_(std::move(meanwhile)),
        changed_(std::move(changed)),
        lost_(std::move(lost)),
        words_(std::move(words)) {}

  bool is_fresh() override;
  std::vector<ros2::msg::ParameterDescriptor> descriptors() override;
  std::optional<ros2::msg::ParameterValue> value(std::string_view name) override;
  ros2::msg::SetParametersResult set(std::span<const ros2::msg::Parameter> parameters) override;

  /// To be called when the values of a new session have just been read.
  void begin(microseconds now) {
    read_at_ = now;
    next_.reset();
  }
  /// If somebody waits for values, reads at least one, and more until `most` has passed. True if more are to be read. Throws
  /// what a request throws.
  bool step(RobotSession& session, microseconds most);
  /// Sets those that the robot has and that differ. "" if they are in force, otherwise why not.
  std::string put_at_start(std::span<const ros2::msg::Parameter> parameters);

 private:
  RobotSession* known_session();
  void note(RobotSession& session);
  void look_up(RobotSession& session);
  void put_in_force(RobotSession& session, std::span<const ros2::msg::Parameter> parameters);
  OwnParameter* own(std::string_view name);
  std::string why_not_own(const ros2::msg::Parameter& wanted);
  std::string why_not_robots(std::span<const ros2::msg::Parameter> parameters);

  Session session_;
  Busy busy_;
  std::vector<OwnParameter> own_;
  std::function<void()> meanwhile_;
  std::function<void(RobotSession&)> changed_;
  std::function<void(const Error&)> lost_;
  std::function<std::string(const Error&)> words_;
  microseconds read_at_{};           // when all values had been read
  std::optional<std::size_t> next_;  // the one that is read again next; none: nobody waits
};

ros2::msg::ParameterValue to_flag(bool value);
ros2::msg::ParameterValue to_parameter(double value);
ros2::msg::ParameterValue to_parameter(const std::string& value);

}  // namespace astro::live
