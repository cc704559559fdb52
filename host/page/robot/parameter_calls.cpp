#include "host/page/robot/parameter_calls.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <variant>
#include <vector>

#include "host/base/error.hpp"
#include "host/page/calls/question.hpp"
#include "host/page/robot/robot_call_problem.hpp"
#include "host/robot/parameters/far_change.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::page {
namespace {

using nlohmann::json;
using robot::ParameterRow;
using robot::RemoteParameters;

json to_json(const robot::Value& value) {
  return std::visit([](const auto& held) { return json(held); }, value);
}

json row_json(const ParameterRow& row) {
  const bool text = row.kind == protocol::ParameterKind::text;
  const auto number = [&](std::int32_t raw) { return text ? json(raw) : json(robot::to_shortest(row, raw)); };
  return {{"name", row.name},
          {"value", to_json(robot::to_value(row, row.active))},
          {"unit", row.unit},
          {"min", number(row.minimum)},
          {"max", number(row.maximum)},
          {"default", text ? json(nullptr) : number(row.default_value)},
          {"doc", row.doc}};
}

robot::Value value_in(const json& question) {
  const auto found = question.find("value");
  if (found != question.end() && found->is_number()) return found->get<double>();
  if (found != question.end() && found->is_string()) return found->get<std::string>();
  throw Error("value is neither a number nor a text");
}

std::vector<std::string> far_of(const RemoteParameters& robot,
                                const std::map<std::string, robot::Value>& values) {
  return robot::far_changes(robot, robot::changes(robot, values));
}

}  // namespace

json ParameterCalls::staged() const {
  json values = json::object();
  for (const auto& [name, value] : staged_) values[name] = to_json(value);
  return values;
}

json ParameterCalls::list(live::RobotSession& session) const {
  json rows = json::array();
  for (const ParameterRow& row : session.parameters().rows()) {
    json each = row_json(row);
    const auto found = staged_.find(row.name);
    each["staged"] = found == staged_.end() ? json(nullptr) : to_json(found->second);
    rows.push_back(std::move(each));
  }
  return {{"parameters", std::move(rows)}};
}

json ParameterCalls::stage(live::RobotSession& session, const json& question) {
  const std::string name = text_in(question, "name");
  const robot::Value value = value_in(question);
  const RemoteParameters& robot = session.parameters();
  robot::to_raw(robot.row(name), value);
  staged_[name] = value;
  return {{"staged", staged()}, {"far", far_of(robot, staged_)}};
}

json ParameterCalls::commit(live::RobotSession& session, const json& question) {
  RemoteParameters& robot = session.parameters();
  if (const auto far = far_of(robot, staged_); !far.empty() && !flag_in(question, "confirm"))
    throw Error(fmt::format("{}: a person has to confirm that", fmt::join(far, "; ")),
                RobotCallProblem::needs_confirmation, far);
  robot::commit_at_rest(
      session.client(), robot, staged_, [] {}, live::RobotSession::kPatience);
  session.note_parameters();
  robot::require_read_back(robot, staged_);
  staged_.clear();
  return list(session);
}

json ParameterCalls::discard() {
  staged_.clear();
  return {{"staged", staged()}};
}

}  // namespace astro::page
