#include "host/truth/source/reading.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/base/text/trimmed.hpp"

namespace astro::truth {
namespace {

/// The number, and what stands behind it.
struct Split {
  std::optional<double> number;
  std::string_view unit;
};

Split split(std::string_view text) {
  text = trimmed(text);
  const std::size_t end = text.find_last_of("0123456789.");
  if (end == std::string_view::npos) return {};
  return {typed_number(trimmed(text.substr(0, end + 1))), trimmed(text.substr(end + 1))};
}

double metres(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::mm:
      return 1e-3;
    case LengthUnit::cm:
      return 1e-2;
    default:
      return 1;
  }
}

double radians_per(AngleUnit unit) { return unit == AngleUnit::deg ? radians(1) : 1; }

std::optional<double> angle_of_marks(std::string_view left, std::string_view apart) {
  const auto a = typed_number(trimmed(left)), b = typed_number(trimmed(apart));
  if (!a || !b || !(*b > 0) || std::abs(*a) > *b) return std::nullopt;
  return std::asin(*a / *b);
}

}  // namespace

std::string_view name_of(LengthUnit unit) {
  return unit == LengthUnit::mm ? "mm" : unit == LengthUnit::cm ? "cm" : "m";
}

std::string_view name_of(AngleUnit unit) { return unit == AngleUnit::deg ? "deg" : "rad"; }

std::optional<LengthUnit> length_unit_named(std::string_view name) {
  for (const LengthUnit unit : {LengthUnit::mm, LengthUnit::cm, LengthUnit::m})
    if (name == name_of(unit)) return unit;
  return std::nullopt;
}

std::optional<AngleUnit> angle_unit_named(std::string_view name) {
  if (name == "°" || name == "degrees") return AngleUnit::deg;
  for (const AngleUnit unit : {AngleUnit::deg, AngleUnit::rad})
    if (name == name_of(unit)) return unit;
  return std::nullopt;
}

std::optional<double> length_m_in(std::string_view text, LengthUnit unit) {
  const Split parts = split(text);
  const auto given = parts.unit.empty() ? std::optional(unit) : length_unit_named(parts.unit);
  if (!parts.number || !given) return std::nullopt;
  return *parts.number * metres(*given);
}

std::optional<double> angle_rad_in(std::string_view text, AngleUnit unit) {
  if (const std::size_t slash = text.find('/'); slash != std::string_view::npos)
    return angle_of_marks(text.substr(0, slash), text.substr(slash + 1));
  const Split parts = split(text);
  const auto given = parts.unit.empty() ? std::optional(unit) : angle_unit_named(parts.unit);
  if (!parts.number || !given) return std::nullopt;
  return *parts.number * radians_per(*given);
}

std::string shown(double length_m, LengthUnit unit) {
  const int decimals = unit == LengthUnit::mm ? 1 : unit == LengthUnit::cm ? 2 : 4;
  const double value = length_m / metres(unit);
  return fmt::format("{:.{}f} {}", without_minus_zero(value, decimals), decimals, name_of(unit));
}

std::string shown(double angle_rad, AngleUnit unit) {
  const int decimals = unit == AngleUnit::deg ? 2 : 4;
  const double value = angle_rad / radians_per(unit);
  return fmt::format("{:.{}f} {}", without_minus_zero(value, decimals), decimals, name_of(unit));
}

}  // namespace astro::truth
