#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/formats/tables/units.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// What a number says about a wheel: its travel so far, or its speed.
struct TravelMeasure {
  std::string_view name;  // "counts", "rad/s"
  WheelUnit unit = WheelUnit::counts;
  double scale = 1;  // of the unit
  bool per_second = false;
};

/// The unit that travel of a quantity, or the integral of a speed, has in a track.
WheelUnit wheel_unit(tables::Quantity quantity);
bool is_travel(tables::Quantity quantity);

/// All measures that can be stated: counts, rad, deg, m, cm, mm, rad/s, rpm, m/s.
std::span<const TravelMeasure> travel_measures();
std::optional<TravelMeasure> travel_measure(std::string_view name);

/// What the name of a topic or a field says.
struct NamedMeasure {
  bool of_wheel = false;                 // such a name is that of a wheel's travel or speed
  std::optional<TravelMeasure> measure;  // if the name shows it, too
};

/// `words`: of the name without the word for the side, separated by blanks. `context`: words around it, such
/// as those of the type, which may say that it is about wheels. Counts are whole numbers, angles are in
/// radians unless the name says otherwise; a commanded or a limiting value is none of the wheel.
NamedMeasure measure_named(std::string_view words, std::string_view context, bool is_integer);

}  // namespace astro::importing
