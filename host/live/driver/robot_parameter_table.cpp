#include "host/live/driver/robot_parameter_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <variant>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/robot/parameters/far_change.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::live {

using protocol::ParameterKind;
using robot::ParameterRow;

namespace {

constexpr microseconds kFresh = std::chrono::seconds(1);  // after this, values are read again

ParameterType type_of(const ParameterRow& row) {
  switch (row.kind) {
    case ParameterKind::text:
      return ParameterType::text;
    case ParameterKind::integer:
      return ParameterType::integer;
    case ParameterKind::flag:
      return ParameterType::boolean;
    default:
      return ParameterType::real;
  }
}

ros2::msg::ParameterDescriptor describe(const ParameterRow& row) {
  ros2::msg::ParameterDescriptor descriptor;
  descriptor.name = row.name;
  descriptor.type = static_cast<std::uint8_t>(type_of(row));
  descriptor.description = row.doc + (row.unit.empty() || row.unit == "1" ? "" : " [" + row.unit + "]");
  if (type_of(row) == ParameterType::real)
    descriptor.floating_point_range = ros2::msg::FloatingPointRange{robot::to_shortest(row, row.minimum),
                                                                    robot::to_shortest(row, row.maximum), 0};
  if (type_of(row) == ParameterType::integer)
    descriptor.integer_range = ros2::msg::IntegerRange{row.minimum, row.maximum, 1};
  return descriptor;
}

ros2::msg::ParameterValue value_of(const ParameterRow& row) {
  ros2::msg::ParameterValue value;
  value.type = static_cast<std::uint8_t>(type_of(row));
  switch (type_of(row)) {
    case ParameterType::text:
      value.string_value = row.active.text;
      break;
    case ParameterType::integer:
      value.integer_value = row.active.raw;
      break;
    case ParameterType::boolean:
      value.bool_value = row.active.raw != 0;
      break;
    default:
      value.double_value = robot::to_shortest(row, row.active.raw);
  }
  return value;
}

std::string in_words(ParameterType type) {
  switch (type) {
    case ParameterType::text:
      return "a text";
    case ParameterType::integer:
      return "a whole number";
    case ParameterType::boolean:
      return "true or false";
    default:
      return "a number";
  }
}

/// Nobody can be asked here, so what a person would have to confirm is refused.
void require_near(const robot::RemoteParameters& robot, const std::map<std::string, robot::Value>& values) {
  const std::vector<std::string> far = robot::far_changes(robot, robot::changes(robot, values));
  if (far.empty()) return;
  std::string assignments;
  for (const auto& [name, value] : values) {
    const auto* number = std::get_if<double>(&value);
    assignments += (assignments.empty() ? "" : " ") + name + '=' +
                   (number == nullptr ? '\'' + std::get<std::string>(value) + '\'' : to_text(*number));
  }
  throw Error(fmt::format("{}: a person has to confirm that", fmt::join(far, "; ")),
              TableProblem::needs_confirmation, {assignments});
}

/// A whole number also stands for a real one, because people leave out the point.
robot::Value wanted(const ParameterRow& row, const ros2::msg::ParameterValue& value) {
  const auto given = static_cast<ParameterType>(value.type);
  const bool whole_for_real = type_of(row) == ParameterType::real && given == ParameterType::integer;
  if (given != type_of(row) && !whole_for_real)
    throw Error(row.name + " has to be " + in_words(type_of(row)));
  switch (given) {
    case ParameterType::text:
      return value.string_value;
    case ParameterType::integer:
      return static_cast<double>(value.integer_value);
    case ParameterType::boolean:
      return value.bool_value ? 1.0 : 0.0;
    default:
      return value.double_value;
  }
}

}  // namespace

ros2::msg::ParameterValue to_flag(bool value) {
  ros2::msg::ParameterValue parameter;
  parameter.type = static_cast<std::uint8_t>(ParameterType::boolean);
  parameter.bool_value = value;
  return parameter;
}

ros2::msg::ParameterValue to_parameter(double value) {
  ros2::msg::ParameterValue parameter;
  parameter.type = static_cast<std::uint8_t>(ParameterType::real);
  parameter.double_value = value;
  return parameter;
}

ros2::msg::ParameterValue to_parameter(const std::string& value) {
  ros2::msg::ParameterValue parameter;
  parameter.type = static_cast<std::uint8_t>(ParameterType::text);
  parameter.string_value = value;
  return parameter;
}

OwnParameter* RobotParameterTable::own(std::string_view name) {
  const auto found = std::ranges::find(own_, name, &OwnParameter::name);
  return found == own_.end() ? nullptr : &*found;
}

/// Why one of the node's own parameters cannot be set; "" if it can, or if it is not one of them.
std::string RobotParameterTable::why_not_own(const ros2::msg::Parameter& wanted) {
  const OwnParameter* one = own(wanted.name);
  if (one == nullptr) return "";
  if (!one->on_set) return wanted.name + " cannot be changed while the node runs";
  if (wanted.value.type != one->value.type)
    return wanted.name + " has to be " + in_words(static_cast<ParameterType>(one->value.type));
  return "";
}

std::vector<ros2::msg::ParameterDescriptor> RobotParameterTable::descriptors() {
  std::vector<ros2::msg::ParameterDescriptor> all;
  for (const OwnParameter& one : own_) {
    ros2::msg::ParameterDescriptor descriptor;
    descriptor.name = one.name;
    descriptor.type = one.value.type;
    descriptor.description = one.doc;
    descriptor.read_only = !one.on_set;
    all.push_back(descriptor);
  }
  if (RobotSession* session = known_session())
    for (const ParameterRow& row : session->parameters().rows()) all.push_back(describe(row));
  return all;
}

RobotSession* RobotParameterTable::known_session() {
  RobotSession* session = session_();
  return session != nullptr && session->knows_parameters() ? session : nullptr;
}

bool RobotParameterTable::is_fresh() {
  RobotSession* session = session_();
  if (session == nullptr) return true;
  if (!session->knows_parameters()) return false;
  if (busy_() || (!next_ && session->client().now() - read_at_ < kFresh)) return true;
  if (!next_) next_ = 0;
  return false;
}

bool RobotParameterTable::step(RobotSession& session, microseconds most) {
  if (busy_()) next_.reset();  // after a drive, all values have to be read again
  if (!next_) return false;
  robot::RemoteParameters& robot = session.parameters();
  const microseconds until = session.client().now() + most;
  do {
    robot.refresh((*next_)++);
  } while (*next_ < robot.rows().size() && session.client().now() < until);
  if (*next_ < robot.rows().size()) return true;
  next_.reset();
  read_at_ = session.client().now();
  note(session);
  return false;
}

void RobotParameterTable::note(RobotSession& session) {
  const auto before = session.numbers();
  session.note_parameters();
  if (session.numbers() != before) changed_(session);
}

std::optional<ros2::msg::ParameterValue> RobotParameterTable::value(std::string_view name) {
  if (const OwnParameter* one = own(name)) return one->value;
  RobotSession* session = known_session();
  if (session == nullptr) return std::nullopt;
  const ParameterRow* row = session->parameters().find(name);
  return row == nullptr ? std::nullopt : std::optional(value_of(*row));
}

ros2::msg::SetParametersResult RobotParameterTable::set(std::span<const ros2::msg::Parameter> parameters) {
  std::vector<ros2::msg::Parameter> of_robot;
  for (const ros2::msg::Parameter& each : parameters) {
    if (const std::string why = why_not_own(each); !why.empty()) return {false, why};
    if (own(each.name) == nullptr) of_robot.push_back(each);
  }
  if (!of_robot.empty())
    if (const std::string why = why_not_robots(of_robot); !why.empty()) return {false, why};
  for (const ros2::msg::Parameter& each : parameters)
    if (OwnParameter* one = own(each.name); one != nullptr && one->value != each.value) {
      one->value = each.value;
      one->on_set(one->value);
    }
  return {true, ""};
}

/// Puts the parameters in force; "" if that was done, otherwise why not.
std::string RobotParameterTable::why_not_robots(std::span<const ros2::msg::Parameter> parameters) {
  RobotSession* session = known_session();
  if (session == nullptr)
    return session_() == nullptr ? "there is no robot" : "the robot's parameters are still being read";
  try {
    put_in_force(*session, parameters);
    return "";
  } catch (const robot::LinkLost& error) {
    lost_(error);
    return words_(error);
  } catch (const Error& error) {
    return words_(error);
  }
}

std::string RobotParameterTable::put_at_start(std::span<const ros2::msg::Parameter> parameters) {
  RobotSession* session = known_session();
  if (session == nullptr) return "there is no robot";
  std::vector<ros2::msg::Parameter> fresh;
  try {
    for (const ros2::msg::Parameter& each : parameters) {
      const ParameterRow* row = session->parameters().find(each.name);
      if (row != nullptr && robot::to_raw(*row, wanted(*row, each.value)) != row->active)
        fresh.push_back(each);
    }
  } catch (const Error& error) {
    return words_(error);
  }
  return fresh.empty() ? "" : why_not_robots(fresh);
}

/// Called between the requests of a set, for work that must not wait for the end of the set. Throws
/// robot::LinkLost if the session has ended meanwhile.
void RobotParameterTable::look_up(RobotSession& session) {
  meanwhile_();
  if (session_() != &session) throw robot::LinkLost("the robot was lost while its parameters were set");
}

void RobotParameterTable::put_in_force(RobotSession& session,
                                       std::span<const ros2::msg::Parameter> parameters) {
  robot::RemoteParameters& robot = session.parameters();
  std::map<std::string, robot::Value> values;
  for (const ros2::msg::Parameter& each : parameters)
    values[each.name] = wanted(robot.row(each.name), each.value);
  require_near(robot, values);
  robot::commit_at_rest(
      session.client(), robot, values, [&] { look_up(session); }, RobotSession::kPatience);
  note(session);
  robot::require_read_back(robot, values);
}

}  // namespace astro::live
