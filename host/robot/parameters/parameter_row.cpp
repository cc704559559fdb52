#include "host/robot/parameters/parameter_row.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/base/text/plain_text.hpp"
#include "host/robot/parameters/parameter_problem.hpp"

namespace astro::robot {

using protocol::ParameterKind;

namespace {

// Powers of ten up to 10^22 are exact doubles: dividing by one rounds once, multiplying by 10^-n rounds
// twice.
double power_of_ten(int exponent) { return std::pow(10.0, exponent); }

double to_steps(const ParameterRow& row, double value) {
  switch (row.kind) {
    case ParameterKind::binary_scaled:
      return std::ldexp(value, -row.exponent);
    case ParameterKind::decimal_scaled:
      return row.exponent < 0 ? value * power_of_ten(-row.exponent) : value / power_of_ten(row.exponent);
    default:
      return value;
  }
}

std::string with_unit(const ParameterRow& row, const std::string& number) {
  const bool plain = row.unit.empty() || row.unit == "1";
  return number + (plain ? "" : " " + row.unit);
}

RawValue raw_number(const ParameterRow& row, double value) {
  const std::string written = describe(row, value), what = row.name + " = " + written;
  if (!std::isfinite(value))
    throw Error(what + " is not a number", ParameterProblem::not_a_number, {row.name});
  const bool whole = row.kind == ParameterKind::integer || row.kind == ParameterKind::flag;
  if (whole && value != std::nearbyint(value))
    throw Error(what + " is not possible: it takes whole numbers", ParameterProblem::not_whole, {row.name});
  const double steps = std::round(to_steps(row, value));
  if (steps < row.minimum || steps > row.maximum) {
    throw Error(what + " is out of range: " + range_of(row), ParameterProblem::out_of_range,
                {row.name, written, range_of(row)});
  }
  return {static_cast<std::int32_t>(steps), {}};
}

RawValue raw_text(const ParameterRow& row, const std::string& text) {
  const auto size = static_cast<std::int64_t>(text.size());
  if (!Text<24>::fits(text) || size < row.minimum || size > row.maximum) {
    throw Error(row.name + " = '" + text + "' has " + std::to_string(size) + " bytes; possible are " +
                    std::to_string(row.minimum) + " to " + std::to_string(row.maximum),
                ParameterProblem::wrong_length, {row.name, std::to_string(size)});
  }
  if (plain_text(text) != text || text.find_first_of("\n\t") != std::string::npos)
    throw Error(row.name + " takes plain text: UTF-8 without control characters");
  return {0, text};
}

/// Whether the robot stores the number as this raw value.
bool is_stored_as(const ParameterRow& row, double value, std::int32_t raw) {
  const bool allowed = value >= to_real(row, row.minimum) && value <= to_real(row, row.maximum);
  return allowed && to_raw(row, value).raw == raw;
}

}  // namespace

double to_real(const ParameterRow& row, std::int32_t raw) {
  switch (row.kind) {
    case ParameterKind::binary_scaled:
      return std::ldexp(raw, row.exponent);
    case ParameterKind::decimal_scaled:
      return row.exponent < 0 ? raw / power_of_ten(-row.exponent) : raw * power_of_ten(row.exponent);
    default:
      return raw;
  }
}

Value to_value(const ParameterRow& row, const RawValue& raw) {
  if (row.kind == ParameterKind::text) return raw.text;
  return to_shortest(row, raw.raw);
}

RawValue to_raw(const ParameterRow& row, const Value& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (row.kind == ParameterKind::text) {
    if (text == nullptr)
      throw Error(row.name + " takes a text, not the number " + to_text(std::get<double>(value)),
                  ParameterProblem::is_text, {row.name});
    return raw_text(row, *text);
  }
  if (text != nullptr)
    throw Error(row.name + " takes a number, not the text '" + *text + "'", ParameterProblem::is_number,
                {row.name});
  return raw_number(row, std::get<double>(value));
}

std::string describe(const ParameterRow& row, const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return "'" + *text + "'";
  return with_unit(row, to_text(std::get<double>(value)));
}

double to_shortest(const ParameterRow& row, std::int32_t raw) {
  const double exact = to_real(row, raw);
  for (int digits = 1; digits < 17; ++digits) {
    const double rounded = std::strtod(fmt::format("{:.{}g}", exact, digits).c_str(), nullptr);
    if (is_stored_as(row, rounded, raw)) return rounded;
  }
  return exact;
}

std::string shortest(const ParameterRow& row, std::int32_t raw) {
  return fmt::format("{}", to_shortest(row, raw));
}

std::string range_of(const ParameterRow& row) {
  return with_unit(row, shortest(row, row.minimum)) + " to " + with_unit(row, shortest(row, row.maximum));
}

}  // namespace astro::robot
