#include "host/ros2/driver/robot_parameter_table.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/error.hpp"

namespace astro::ros2 {

using protocol::ParameterKind;
using robot::ParameterRow;

namespace {

/// Other programs may change the robot's parameters, too, so values are read again after this; not while the robot is armed,
/// because on a slow line the whole table takes as long as the robot's own time-out.
constexpr microseconds kFresh = std::chrono::seconds(1);

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

msg::ParameterDescriptor describe(const ParameterRow& row) {
  msg::ParameterDescriptor descriptor;
  descriptor.name = row.name;
  descriptor.type = static_cast<std::uint8_t>(type_of(row));
  descriptor.description = row.doc + (row.unit.empty() || row.unit == "1" ? "" : " [" + row.unit + "]");
  if (type_of(row) == ParameterType::real)
    descriptor.floating_point_range =
        msg::FloatingPointRange{robot::to_real(row, row.minimum), robot::to_real(row, row.maximum), 0};
  if (type_of(row) == ParameterType::integer)
    descriptor.integer_range = msg::IntegerRange{row.minimum, row.maximum, 1};
  return descriptor;
}

msg::ParameterValue value_of(const ParameterRow& row) {
  msg::ParameterValue value;
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
      value.double_value = robot::to_real(row, row.active.raw);
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

/// A whole number also stands for a real one, because people leave out the point.
robot::Value wanted(const ParameterRow& row, const msg::ParameterValue& value) {
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

msg::ParameterValue to_parameter(double value) {
  msg::ParameterValue parameter;
  parameter.type = static_cast<std::uint8_t>(ParameterType::real);
  parameter.double_value = value;
  return parameter;
}

msg::ParameterValue to_parameter(const std::string& value) {
  msg::ParameterValue parameter;
  parameter.type = static_cast<std::uint8_t>(ParameterType::text);
  parameter.string_value = value;
  return parameter;
}

const FixedParameter* RobotParameterTable::fixed(std::string_view name) const {
  const auto found =
      std::find_if(fixed_.begin(), fixed_.end(), [&](const auto& one) { return one.name == name; });
  return found == fixed_.end() ? nullptr : &*found;
}

std::vector<msg::ParameterDescriptor> RobotParameterTable::descriptors() {
  std::vector<msg::ParameterDescriptor> all;
  for (const FixedParameter& one : fixed_) {
    msg::ParameterDescriptor descriptor;
    descriptor.name = one.name;
    descriptor.type = one.value.type;
    descriptor.description = one.doc;
    descriptor.read_only = true;
    all.push_back(descriptor);
  }
  if (RobotSession* session = session_())
    for (const ParameterRow& row : session->parameters().rows()) all.push_back(describe(row));
  return all;
}

void RobotParameterTable::refresh(RobotSession& session) {
  const microseconds now = session.client().now();
  if (of_ == &session && (busy_() || now - read_at_ < kFresh)) return;
  const auto before = session.numbers();
  session.parameters().refresh();
  session.note_parameters();
  of_ = &session;
  read_at_ = now;
  if (session.numbers() != before) changed_(session);
}

std::optional<msg::ParameterValue> RobotParameterTable::value(std::string_view name) {
  if (const FixedParameter* one = fixed(name)) return one->value;
  RobotSession* session = session_();
  if (session == nullptr || session->parameters().find(name) == nullptr) return std::nullopt;
  try {
    refresh(*session);
    return value_of(session->parameters().row(name));
  } catch (const robot::LinkLost& error) {
    lost_(error);
  } catch (
      const Error&) {  // other firmware at the same port: it refuses, or answers what cannot be understood
  }
  return std::nullopt;
}

msg::SetParametersResult RobotParameterTable::set(std::span<const msg::Parameter> parameters) {
  for (const msg::Parameter& each : parameters)
    if (fixed(each.name) != nullptr) return {false, each.name + " cannot be changed while the node runs"};
  RobotSession* session = session_();
  if (session == nullptr) return {false, "there is no robot"};
  try {
    put_in_force(*session, parameters);
    return {true, ""};
  } catch (const robot::LinkLost& error) {
    lost_(error);
    return {false, error.what()};
  } catch (const Error& error) {
    return {false, error.what()};
  }
}

void RobotParameterTable::put_in_force(RobotSession& session, std::span<const msg::Parameter> parameters) {
  robot::RemoteParameters& robot = session.parameters();
  robot.revert();
  for (const msg::Parameter& each : parameters)
    robot.stage(each.name, wanted(robot.row(each.name), each.value));
  robot.commit();
  of_ = nullptr;
  refresh(session);
  for (const msg::Parameter& each : parameters) {
    const ParameterRow& row = robot.row(each.name);
    if (row.active != robot::to_raw(row, wanted(row, each.value)))
      throw Error(row.name + " was read back as " + robot::describe(row, robot::to_value(row, row.active)));
  }
}

}  // namespace astro::ros2
