#include "host/robot/parameters/parameters.hpp"

#include <algorithm>
#include <utility>

#include "host/base/text/plain_text.hpp"
#include "host/robot/parameters/parameter_rules.hpp"

namespace astro::robot {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages

namespace {

ParameterRow describe_row(const ParameterInfo& info) {
  ParameterRow row;
  row.id = info.id;
  row.name = plain_text(info.name.view());
  row.unit = plain_text(info.unit.view());
  row.doc = plain_text(info.doc.view());
  row.kind = info.kind;
  row.exponent = info.scale_exponent;
  row.minimum = info.minimum;
  row.maximum = info.maximum;
  row.default_value = info.default_value;
  return row;
}

}  // namespace

RemoteParameters RemoteParameters::begin(Client& client, int tries) {
  if (client.robot().parameter_count > kMostParameters)
    throw Error("the robot at " + client.name() + " says that it has " +
                std::to_string(client.robot().parameter_count) + " parameters, more than " +
                std::to_string(kMostParameters) + ": its firmware is damaged or not Astrolabe's");
  return {client, tries};
}

RemoteParameters RemoteParameters::fetch(Client& client, int tries) {
  RemoteParameters parameters = begin(client, tries);
  while (!parameters.is_complete()) parameters.read_next();
  return parameters;
}

bool RemoteParameters::is_complete() const { return rows_.size() >= client_->robot().parameter_count; }

void RemoteParameters::read_next() {
  ParameterRow row = describe_row(ask(GetParameterInfo{static_cast<std::uint16_t>(rows_.size())}));
  read_value(row);
  rows_.push_back(std::move(row));
}

void RemoteParameters::read_value(ParameterRow& row) {
  const ParameterValue held = ask(GetParameter{row.id});
  row.active = {held.active, std::string(held.active_text.view())};
  row.staged = {held.staged, std::string(held.staged_text.view())};
}

void RemoteParameters::refresh() {
  for (ParameterRow& row : rows_) read_value(row);
}

const ParameterRow* RemoteParameters::find(std::string_view name) const {
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [&](const auto& row) { return row.name == name; });
  return found == rows_.end() ? nullptr : &*found;
}

const ParameterRow& RemoteParameters::row(std::string_view name) const {
  if (const ParameterRow* found = find(name)) return *found;
  throw Error("the robot has no parameter '" + std::string(name) + "'", {Help::list_parameters});
}

ParameterRow& RemoteParameters::mutable_row(std::string_view name) {
  return rows_[static_cast<std::size_t>(&row(name) - rows_.data())];
}

Value RemoteParameters::value(std::string_view name) const { return to_value(row(name), row(name).active); }

double RemoteParameters::number(std::string_view name) const {
  const ParameterRow& found = row(name);
  if (found.kind == ParameterKind::text)
    throw Error("the robot's parameter '" + found.name + "' is a text, not a number");
  return to_real(found, found.active.raw);
}

std::map<std::string, double> RemoteParameters::numbers() const {
  std::map<std::string, double> numbers;
  for (const ParameterRow& row : rows_)
    if (row.kind != ParameterKind::text) numbers[row.name] = to_real(row, row.active.raw);
  return numbers;
}

void RemoteParameters::stage(std::string_view name, const Value& value) {
  ParameterRow& row = mutable_row(name);
  const RawValue raw = to_raw(row, value);
  if (!opened_) revert();
  try {
    ask(StageParameter{row.id, raw.raw, Text<24>(raw.text)});
  } catch (const RobotRefused& refused) {
    if (refused.code() == ErrorCode::staging_lost) throw;
    throw RobotRefused(row.name + " = " + describe(row, to_value(row, raw)), refused.code(),
                       refused.detail());
  }
  row.staged = raw;
}

void RemoteParameters::commit() { put_in_force(CommitParameters{}); }
void RemoteParameters::apply() { put_in_force(ApplyParameters{}); }

template <class Request>
void RemoteParameters::put_in_force(const Request& request) {
  if (!opened_) revert();
  try {
    ask(request);
  } catch (const RobotRefused& refused) {
    const auto bad =
        std::find_if(rows_.begin(), rows_.end(), [&](const auto& r) { return r.id == refused.detail(); });
    if (refused.code() != ErrorCode::invalid_parameter || bad == rows_.end()) throw;
    throw RobotRefused(
        "the new set because of " + bad->name + " = " + describe(*bad, to_value(*bad, bad->staged)),
        refused.code(), refused.detail(), broken_rule(rows_, *bad));
  }
  for (ParameterRow& row : rows_) row.active = row.staged;
}

void RemoteParameters::save() {
  revert();
  for (const ParameterRow& row : rows_) stage(row.name, to_value(row, row.active));
  commit();
}

void RemoteParameters::revert() {
  ask(RevertParameters{});
  opened_ = true;
  for (ParameterRow& row : rows_) row.staged = row.active;
}

void RemoteParameters::defaults() {
  ask(DefaultParameters{});
  opened_ = true;
  refresh();
}

}  // namespace astro::robot
