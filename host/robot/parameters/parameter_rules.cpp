#include "host/robot/parameters/parameter_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "common/params/parameter_set.hpp"
#include "host/base/text/degrees.hpp"

namespace astro::robot {
namespace {

class Staged {
 public:
  explicit Staged(std::span<const ParameterRow> rows) : rows_(rows) {}

  std::optional<double> number(std::string_view name) const {
    const auto row = std::ranges::find(rows_, name, &ParameterRow::name);
    if (row == rows_.end() || row->kind == protocol::ParameterKind::text) return std::nullopt;
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
    const double narrower = std::min(staged.number("e").value_or(0), 0.0);  // in curves
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
  if (row.kind == protocol::ParameterKind::text)
    return "it takes " + std::to_string(row.minimum) + " to " + std::to_string(row.maximum) +
           " characters of printable ASCII";
  const double staged = to_real(row, row.staged.raw), least = to_real(row, row.minimum),
               greatest = to_real(row, row.maximum);
  if (staged >= least && staged <= greatest) return "";
  return "it has to be from " + range_of(row);
}

}  // namespace

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

}  // namespace astro::robot
