#include "host/robot/parameters/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "common/params/parameter_set.hpp"
#include "host/base/text/degrees.hpp"
#include "host/base/text/plain_text.hpp"
#include "host/robot/parameters/parameter_problem.hpp"

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

class Staged {
 public:
  explicit Staged(std::span<const ParameterRow> rows) : rows_(rows) {}

  std::optional<double> number(std::string_view name) const {
    const auto row = std::ranges::find(rows_, name, &ParameterRow::name);
    if (row == rows_.end() || row->kind == ParameterKind::text) return std::nullopt;
    return to_real(*row, row->staged.raw);
  }

  /// "speed_limit = 0.75 m/s"
  std::string shown(std::string_view name) const {
    const auto row = std::ranges::find(rows_, name, &ParameterRow::name);
    if (row == rows_.end()) return std::string(name);
    return row->name + " = " + describe(*row, to_value(*row, row->staged));
  }

  /// How far one encoder count moves the larger wheel.
  std::optional<double> travel_per_count_m() const {
    const auto c_r = number("c_R"), c_l = number("c_L"), diameter_m = number("wheel_diameter"),
               counts = number("counts_per_motor_rev"), motor_turns = number("gear_numerator"),
               wheel_turns = number("gear_denominator");
    if (!c_r || !c_l || !diameter_m || !counts || !motor_turns || !wheel_turns) return std::nullopt;
    return std::numbers::pi * *diameter_m * std::max(*c_r, *c_l) * *wheel_turns / (*counts * *motor_turns);
  }

 private:
  std::span<const ParameterRow> rows_;
};

std::string digits(double value) { return fmt::format("{:.3g}", value); }

std::string geometry_rule(const Staged& staged, std::string_view name) {
  const auto travel_m = staged.travel_per_count_m();
  const auto b_m = staged.number("b");
  if (!travel_m || !b_m) return "";
  if (name == "b") {
    const double narrower = std::min(staged.number("e").value_or(0), 0.0);  // gentle arcs: about b (1 + e)
    return "one count turns the robot by " + digits(degrees(*travel_m / (*b_m * (1 + narrower)))) +
           " degrees, and has to turn it by less than " + digits(360.0 / kFewestCountsPerTurn) +
           " degrees; that follows from " + staged.shown("b") + ", " +
           (narrower < 0 ? staged.shown("e") + ", " : "") + "the wheel, the gear and the encoder";
  }
  return "one count moves a wheel by " + digits(*travel_m) + " m, and that has to be from " +
         digits(1e-9 * kShortestCount_nm) + " m to " + digits(1e-9 * kLongestCount_nm) +
         " m; that follows from " + staged.shown("counts_per_motor_rev") + ", " +
         staged.shown("gear_numerator") + ", " + staged.shown("gear_denominator") + " and " +
         staged.shown("wheel_diameter");
}

std::string limits_rule(const ParameterRow& row) {
  if (row.kind == ParameterKind::text)
    return "it takes " + std::to_string(row.minimum) + " to " + std::to_string(row.maximum) +
           " characters of printable ASCII";
  const double staged = to_real(row, row.staged.raw), least = to_real(row, row.minimum),
               greatest = to_real(row, row.maximum);
  if (staged >= least && staged <= greatest) return "";
  return "it has to be from " + range_of(row);
}

/// The rule that the staged value of `bad` breaks, as a clause with the limit, its unit and the values that
/// it depends on: "it has to be above speed_limit = 0.75 m/s, or full speed would be a fault". The robot
/// named `bad` when it refused the set; `rows` is the whole table. Empty if this program knows no such rule,
/// because the firmware may be newer. The rules are those of common/params/parameter_set.hpp.
std::string broken_rule(std::span<const ParameterRow> rows, const ParameterRow& bad) {
  const Staged staged(rows);
  if (std::string limits = limits_rule(bad); !limits.empty()) return limits;
  if (bad.name.find("polarity") != std::string::npos) return "it has to be +1 or -1";
  if (bad.name == "battery_high")
    return "it has to be above " + staged.shown("battery_low") +
           " unless one of the two is 0, which disables it";
  if (bad.name == "over_speed")
    return "it has to be above " + staged.shown("speed_limit") + ", or full speed would be a fault";
  if (bad.name == "counts_per_motor_rev" || bad.name == "b") return geometry_rule(staged, bad.name);
  return "";
}

}  // namespace

RemoteParameters RemoteParameters::begin(Client& client, int tries) {
  if (client.robot().parameter_count > kMostParameters)
    throw Error("the robot at " + client.name() + " says that it has " +
                    std::to_string(client.robot().parameter_count) + " parameters, more than " +
                    std::to_string(kMostParameters) + ": its firmware is damaged or not Astrolabe's",
                ParameterProblem::too_many, {std::to_string(client.robot().parameter_count)});
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
  throw Error("the robot has no parameter '" + std::string(name) + "'", ParameterProblem::unknown,
              {std::string(name)});
}

ParameterRow& RemoteParameters::mutable_row(std::string_view name) {
  return rows_[static_cast<std::size_t>(&row(name) - rows_.data())];
}

Value RemoteParameters::value(std::string_view name) const { return to_value(row(name), row(name).active); }

double RemoteParameters::number(std::string_view name) const {
  const ParameterRow& found = row(name);
  if (found.kind == ParameterKind::text)
    throw Error("the robot's parameter '" + found.name + "' is a text, not a number",
                ParameterProblem::is_text, {found.name});
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
    const std::string written = describe(row, to_value(row, raw));
    throw RobotRefused(row.name + " = " + written, refused.code(), refused.detail(), {}, {row.name, written});
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
    const std::string written = describe(*bad, to_value(*bad, bad->staged));
    throw RobotRefused("the new set because of " + bad->name + " = " + written, refused.code(),
                       refused.detail(), broken_rule(rows_, *bad), {bad->name, written});
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
