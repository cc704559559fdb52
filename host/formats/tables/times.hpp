#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/formats/tables/rows.hpp"

/// Times as tables write them, in whole nanoseconds.
namespace astro::tables {

enum class TimeKind : std::uint8_t {
  number,  // in some unit, since any start
  date,    // a date and a time of day, ISO 8601, DD.MM.YYYY or with slashes; UTC unless it says otherwise
  clock,   // a time of day alone: 14:05:09.25, 2:05 PM, 05:09.25 (minutes)
};

struct TimeFormat {
  TimeKind kind = TimeKind::number;
  int power = 9;  // of a number: of ten, to nanoseconds (seconds: 9)
};

/// Nothing if the cell is no such time.
std::optional<std::int64_t> time_ns(std::string_view cell, TimeFormat format, NumberStyle style);

/// What is read as a time, for a message about what is not.
inline constexpr std::string_view kTimesRead =
    "a number, a time of day as 14:05:09.25 or 2:05:09.25 PM, or a date and time as 2024-05-31 14:05:09.25, "
    "31.05.2024 14:05:09.25 or 31/05/2024 14:05:09.25 (with slashes only after the 12th of a month, because "
    "before it nothing shows which of the two numbers is the month)";

/// Whether the cell is a date with a time, or a time of day.
std::optional<TimeKind> written_time(std::string_view cell);

/// Seconds, milliseconds, microseconds or nanoseconds ("s", "ms", "us", "ns").
std::string_view unit_text(int power);

/// The unit of times that are numbers without one, found from their size or from their spacing: recordings of robots have
/// between 1.5 and 1500 rows in a second, so that one unit fits. If with that unit the whole recording lasts less than two
/// seconds, the next larger one is chosen, unless it makes the recording longer than two hours or the rows rarer than one in
/// five seconds. Nothing if the times do not increase, or if no unit fits.
/// `times`: those of some rows from the beginning, `span`: how long the whole recording lasts, in their unit.
std::optional<int> power_found(std::span<const double> times, double span);

}  // namespace astro::tables
