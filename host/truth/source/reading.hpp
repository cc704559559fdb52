#pragma once

#include <optional>
#include <string>
#include <string_view>

/// What a person reads off a tape measure, as they type it.
namespace astro::truth {

enum class LengthUnit { mm, cm, m };
enum class AngleUnit { deg, rad };

/// The units of numbers without one.
struct Units {
  LengthUnit length = LengthUnit::mm;
  AngleUnit angle = AngleUnit::deg;
};

/// "mm", "cm", "m"; "deg", "rad". Nothing for any other text.
std::string_view name_of(LengthUnit unit);
std::string_view name_of(AngleUnit unit);
std::optional<LengthUnit> length_unit_named(std::string_view name);
std::optional<AngleUnit> angle_unit_named(std::string_view name);

/// "12", "1.2 cm", "-0.012m". Nothing unless it is one finite number, perhaps with one of the units.
std::optional<double> length_m_in(std::string_view text, LengthUnit unit);

/// "3.5", "3.5 deg", "0.06 rad"; or "18/300" of two marks on the chassis: how much further left the front one is than the
/// rear one, over their distance, both in the same unit. Nothing for anything else, also if the first is larger than the second.
std::optional<double> angle_rad_in(std::string_view text, AngleUnit unit);

/// "-12.5 mm", "0.0125 m": in this unit, to a tenth of a millimetre.
std::string shown(double length_m, LengthUnit unit);
/// "3.52 deg", "0.0614 rad".
std::string shown(double angle_rad, AngleUnit unit);

}  // namespace astro::truth
