#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// Which columns of a table hold the time and the wheels, and in which units.
struct WheelColumns {
  std::size_t time = 0, left = 0, right = 0;  // from 0
  std::int64_t time_unit_ns = 0;              // 1'000'000'000 for seconds
  WheelUnit unit = WheelUnit::counts;
  double scale = 1;           // of a value to radians, metres or counts
  bool per_interval = false;  // each row is the travel since the row before

  bool operator==(const WheelColumns&) const = default;
};

/// The columns with these names. A name consists of words and a unit at its end, in any case and with any
/// separators: "time_s", "Time (ms)", "stamp_ns"; "left_counts" (also ticks, pulses, steps), "Right wheel
/// [rad]", "left_deg", "left_m", "left_mm". With the word "delta" or "per_interval" the values are travel per
/// interval. A column with a name of another kind is not used. Nothing if one of the three columns is missing
/// or not unique, or if the wheels have different units.
std::optional<WheelColumns> wheel_columns(std::span<const std::string_view> names);

}  // namespace astro::importing
