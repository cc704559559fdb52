#include "host/experiment/drive/change_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "host/base/error.hpp"
#include "host/experiment/files/curvature_named.hpp"
#include "host/experiment/files/same_number.hpp"

namespace astro::experiment {
namespace {

constexpr double kMostChange = 0.10;

double relative(const Change& change) {
  const double* before = std::get_if<double>(&change.before);
  const double* after = std::get_if<double>(&change.after);
  return before != nullptr && after != nullptr && *before != 0 ? *after / *before - 1 : 0;
}

/// The change in percent, or in words if the sign changes: a polarity that goes from -1 to 1 would be -200 %.
std::string change_in_words(const Change& change) {
  const double* before = std::get_if<double>(&change.before);
  const double* after = std::get_if<double>(&change.after);
  if (before == nullptr || after == nullptr || *before == 0) return "";
  if (*after == -*before) return "reversed";
  if (*after != 0 && std::signbit(*after) != std::signbit(*before)) return "other sign";
  const double percent = 100 * (*after / *before - 1);
  const bool is_visible = std::abs(percent) >= 5e-5;
  return is_visible ? fmt::format("{:+.4f} %", percent) : "< 0.0001 %";
}

std::optional<Remark> of_other_robot(const ParameterFile& file, const RobotIdentity& identity) {
  const std::string why = different_robots("the calibration", file.robot, "this", identity);
  if (why.empty()) return std::nullopt;
  return Remark{why, UploadProblem::of_other_robot, {file.robot.id, identity.id}};
}

std::optional<Remark> incomplete(const ParameterFile& file) {
  const auto has = [&](const char* name) { return file.parameters.contains(name); };
  if (file.method.empty() || (has("c_R") && has("c_L") && has("b"))) return std::nullopt;
  const char* missing = !has("c_R") ? "c_R" : !has("c_L") ? "c_L" : "b";
  return Remark{fmt::format("the calibration has no {}, and c_R, c_L and b were found together", missing),
                UploadProblem::incomplete,
                {missing}};
}

/// In a calibration without e all arcs turn about b, so its b does not go with an e that the robot holds.
std::optional<Remark> foreign_e(const robot::RemoteParameters& robot, const ParameterFile& file) {
  if (file.method.empty() || file.parameters.contains("e")) return std::nullopt;
  const double e = loaded_factors(robot).e;
  if (same_number(e, 0)) return std::nullopt;
  const std::string held = fmt::format("{:.6g}", e);
  return Remark{
      "the calibration knows no e, and the robot holds e = " + held + ", which its b does not go with",
      UploadProblem::foreign_e,
      {held}};
}

std::string shown(const robot::Value& value) {
  if (const double* number = std::get_if<double>(&value)) return fmt::format("{:.9g}", *number);
  return std::get<std::string>(value);
}

bool knows_e(std::span<const robot::ParameterRow> robot) {
  return std::ranges::find(robot, "e", &robot::ParameterRow::name) != robot.end();
}

}  // namespace

calibration::WheelFactors loaded_factors(const robot::RemoteParameters& robot) {
  return with_curvature_named({robot.number("c_R"), robot.number("c_L"), robot.number("b")}, robot.numbers(),
                              "the robot");
}

void require_e(std::span<const robot::ParameterRow> robot) {
  if (knows_e(robot)) return;
  throw Error("maximum likelihood finds a factor e, and this robot's firmware has no e",
              UploadProblem::e_needed);
}

ParameterValues understood_by(std::span<const robot::ParameterRow> robot, ParameterValues values) {
  if (knows_e(robot)) return values;
  if (const double e = number_named(values, "e").value_or(0); e != 0) {
    const std::string number = fmt::format("{:.6g}", e);
    throw Error("the calibration has e = " + number +
                    ", and this robot's firmware has no e: it would turn gentle arcs about the wheelbase of "
                    "spins: update the robot's firmware",
                UploadProblem::e_unknown_to_firmware, {number});
  }
  values.erase("e");
  values.erase("kappa0");
  return values;
}

std::optional<Remark> suspicion(const std::vector<Change>& changes) {
  for (const Change& change : changes) {
    if (change.name == "e" && robot::is_far_e(change)) {
      const std::string before = shown(change.before), after = shown(change.after);
      return Remark{
          fmt::format("e would go from {} to {}, and tyres give it a few hundredths at most", before, after),
          UploadProblem::suspicious,
          {change.name, before, after}};
    }
    const bool measured_by_ratio =
        robot::is_wheel_factor(change.name) && change.name != "e" && change.name != "kappa0";
    if (!measured_by_ratio || !(std::abs(relative(change)) > kMostChange)) continue;
    const std::string percent = fmt::format("{:+.1f}", 100 * relative(change));
    return Remark{fmt::format("{} would change by {} %, and a calibration moves it by a few at most",
                              change.name, percent),
                  UploadProblem::suspicious,
                  {change.name, percent}};
  }
  return std::nullopt;
}

std::optional<Remark> wrong_loaded_factors(const robot::RemoteParameters& robot, const ParameterFile& file) {
  if (file.absolute || file.loaded.empty()) return std::nullopt;
  std::map<std::string, double> then = file.loaded;
  then.try_emplace("e", 0);  // older versions did not know it
  const calibration::WheelFactors held = loaded_factors(robot);
  for (const auto& [name, loaded] : then) {
    if (name == "kappa0" && same_number(held.e, 0)) continue;  // no effect if e is 0
    const double now = name == "e" ? held.e : name == "kappa0" ? held.kappa0 : robot.number(name);
    if (same_number(now, loaded)) continue;
    const std::string then_text = fmt::format("{:.9g}", loaded), now_text = fmt::format("{:.9g}", now);
    return Remark{fmt::format("the calibration was driven with {} = {}, and the robot now holds {}", name,
                              then_text, now_text),
                  UploadProblem::of_other_factors,
                  {name, then_text, now_text}};
  }
  return std::nullopt;
}

std::optional<Remark> wrong_wheel(const robot::RemoteParameters& robot, const ParameterFile& file) {
  if (!file.wheel) return std::nullopt;
  const NominalWheel now{robot.number("wheel_diameter"), robot.number("counts_per_motor_rev") *
                                                             robot.number("gear_numerator") /
                                                             robot.number("gear_denominator")};
  if (now.measures_like(*file.wheel)) return std::nullopt;
  return Remark{fmt::format("the calibration refers to {}, and the robot's parameters now give {}",
                            file.wheel->described(), now.described()),
                UploadProblem::of_other_wheel,
                {file.wheel->described(), now.described()}};
}

std::vector<Remark> objections(const robot::RemoteParameters& robot, const RobotIdentity& identity,
                               const ParameterFile& file, const std::vector<Change>& changes) {
  std::vector<Remark> all;
  for (const std::optional<Remark>& why :
       {of_other_robot(file, identity), incomplete(file), foreign_e(robot, file), wrong_wheel(robot, file),
        wrong_loaded_factors(robot, file), suspicion(changes)})
    if (why) all.push_back(*why);
  return all;
}

std::string insignificance(const std::vector<Change>& changes,
                           const std::map<std::string, double>& standard_errors) {
  bool any = false;
  for (const Change& change : changes) {
    if (!robot::is_wheel_factor(change.name)) return {};
    const auto error = standard_errors.find(change.name);
    if (error == standard_errors.end() || !(error->second > 0)) return {};
    if (std::abs(std::get<double>(change.after) - std::get<double>(change.before)) > 2 * error->second)
      return {};
    any = true;
  }
  return any ? "no factor changes by more than twice its standard error: what is loaded may be as "
               "good"
             : "";
}

std::vector<std::vector<std::string>> side_by_side(const std::vector<Change>& changes) {
  std::vector<std::vector<std::string>> rows{{"parameter", "unit", "on the robot", "new", "change"}};
  for (const Change& change : changes)
    rows.push_back(
        {change.name, change.unit, shown(change.before), shown(change.after), change_in_words(change)});
  return rows;
}

}  // namespace astro::experiment
