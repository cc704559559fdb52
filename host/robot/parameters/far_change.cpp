#include "host/robot/parameters/far_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace astro::robot {
namespace {

constexpr double kMostChange = 0.10;
constexpr double kMostChangeOfE = 0.10;  // tyres have an e of a few hundredths

/// A change by this factor or more, up or down, is far.
double far_factor(std::string_view name) {
  constexpr std::array kNominalSizes{"wheel_diameter", "counts_per_motor_rev", "gear_numerator",
                                     "gear_denominator"};
  constexpr std::array kLimits{
      "speed_limit",    "yaw_rate_limit",    "acceleration_limit", "yaw_acceleration_limit", "jerk_limit",
      "yaw_jerk_limit", "motor_voltage_max", "battery_low",        "battery_high",           "over_speed"};
  const auto among = [name](const auto& names) { return std::ranges::find(names, name) != names.end(); };
  if (name == "kappa0") return 10;  // a fifth or five times of it fits drives about as well
  if (is_wheel_factor(name)) return 1 + kMostChange;
  if (among(kNominalSizes)) return 1.25;
  return among(kLimits) ? 2 : 3;
}

std::string times(double ratio) {
  if (ratio > 1 / 1.5 && ratio < 1.5) return fmt::format("{:+.1f} %", 100 * (ratio - 1));
  return ratio > 1 ? fmt::format("{:.3g} times as much", ratio) : fmt::format("1/{:.3g} of it", 1 / ratio);
}

/// What 0 switches off, as a clause, if a person should know it; otherwise "".
std::string_view lost_by_zero(std::string_view name) {
  return name == "command_timeout" ? ", and without it a robot keeps driving if its host disappears" : "";
}

/// Empty if the change is not far.
std::string far_change(const ParameterRow& row, const Change& change) {
  const double *before = std::get_if<double>(&change.before), *after = std::get_if<double>(&change.after);
  if (before == nullptr || after == nullptr || row.name == "telemetry_period")
    return {};  // this parameter has no effect any more
  const std::string step =
      fmt::format("{} would go from {} to {}", row.name, describe(row, *before), describe(row, *after));
  if (row.name == "e") return is_far_e(change) ? step : "";
  if (*after == 0) return fmt::format("{}{}", step, lost_by_zero(row.name));
  const double usual = *before != 0 ? *before : to_shortest(row, row.default_value);
  if (usual == 0) return {};
  const double ratio = *after / usual, most = far_factor(row.name);
  if (ratio < 0) return step + ", another sign";
  constexpr double kRounding =
      1e-6;  // stored values are rounded, so a change of a tenth may be stored as slightly more
  if (ratio < most * (1 + kRounding) && ratio > 1 / most * (1 - kRounding)) return {};
  return fmt::format("{}, {}{}", step, times(ratio), *before != 0 ? "" : " (compared with the default)");
}

}  // namespace

bool is_wheel_factor(std::string_view name) {
  return name == "c_R" || name == "c_L" || name == "b" || name == "e" || name == "kappa0";
}

bool is_far_e(const Change& change) {
  const double *before = std::get_if<double>(&change.before), *after = std::get_if<double>(&change.after);
  constexpr double kRounding = 1e-8;
  return before != nullptr && after != nullptr && std::abs(*after - *before) > kMostChangeOfE + kRounding;
}

std::vector<Change> changes(const RemoteParameters& robot, const std::map<std::string, Value>& values) {
  for (const auto& [name, value] : values) robot.row(name);  // throws for names that the robot does not have
  std::vector<Change> list;
  for (const ParameterRow& row : robot.rows()) {
    const auto found = values.find(row.name);
    if (found == values.end()) continue;
    const RawValue raw = to_raw(row, found->second);
    if (raw == row.active) continue;
    list.push_back({row.name, row.unit, to_value(row, row.active), to_value(row, raw)});
  }
  return list;
}

std::vector<std::string> far_changes(const RemoteParameters& robot, const std::vector<Change>& changes) {
  std::vector<std::string> clauses;
  for (const Change& change : changes)
    if (std::string clause = far_change(robot.row(change.name), change); !clause.empty())
      clauses.push_back(std::move(clause));
  return clauses;
}

}  // namespace astro::robot
