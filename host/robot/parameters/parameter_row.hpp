#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "common/protocol/parameters.hpp"

namespace astro::robot {

/// A value as people write and read it: a number in the row's unit, or a text.
using Value = std::variant<double, std::string>;

/// A value as the robot holds it. The text is empty unless the row's kind is text; raw is 0 if it is.
struct RawValue {
  std::int32_t raw = 0;
  std::string text;
  bool operator==(const RawValue&) const = default;
};

/// One row of the robot's own parameter table, with the values that it holds.
struct ParameterRow {
  std::uint16_t id = 0;
  std::string name, unit, doc;
  protocol::ParameterKind kind{};
  int exponent = 0;
  std::int32_t minimum = 0, maximum = 0;  // raw; for a text: limits of its length in bytes
  std::int32_t default_value = 0;         // raw; the table has no default of a text
  RawValue active;                        // in force
  RawValue staged;                        // what a commit would put in force
};

/// Exact for raw * 2^exponent; for raw * 10^exponent the double nearest to the decimal number.
double to_real(const ParameterRow& row, std::int32_t raw);

/// The number with the fewest digits that the robot stores as this raw one: 1.002 for c_R, which the robot holds as
/// 1.0020000003278255. Calculations must use to_real(). Not for texts.
double to_shortest(const ParameterRow& row, std::int32_t raw);

/// A raw value as people read and wrote it: the shortest number, or the text.
Value to_value(const ParameterRow& row, const RawValue& raw);

/// Nearest raw value. Throws Error, naming parameter, value, unit and limits, for what the row does not
/// allow: not a number, out of range, a fraction for an integer or flag, a number for a text and the reverse.
RawValue to_raw(const ParameterRow& row, const Value& value);

/// to_shortest() as text: "0.9" for a gain of 0.899993896484375.
std::string shortest(const ParameterRow& row, std::int32_t raw);

/// "0.05 m to 2 m". Not for texts.
std::string range_of(const ParameterRow& row);

/// "0.29 m", "'astro'": shortest digits that give the same double again.
std::string describe(const ParameterRow& row, const Value& value);

}  // namespace astro::robot
