#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

/// Times as tables write them, in whole nanoseconds.
namespace astro::tables {

enum class TimeKind : std::uint8_t {
  number,  // in some unit, since any start
  date,    // a date and a time of day, ISO 8601 or DD.MM.YYYY; UTC unless it says otherwise
  clock,   // a time of day alone: 14:05:09.25
};

struct TimeFormat {
  TimeKind kind = TimeKind::number;
  int power = 9;  // of a number: of ten, to nanoseconds (seconds: 9)
};

/// Nothing if the cell is no such time.
std::optional<std::int64_t> time_ns(std::string_view cell, TimeFormat format, char separator);

/// Whether the cell is a date with a time, or a time of day.
std::optional<TimeKind> written_time(std::string_view cell);

/// Seconds, milliseconds, microseconds or nanoseconds ("s", "ms", "us", "ns").
std::string_view unit_text(int power);

/// The unit of times that are numbers without one, found from their size or from their spacing: recordings of robots have
/// between 1.5 and 1500 rows in a second, so that one unit fits. A slower or faster one is chosen if only then the whole
/// recording lasts as long as a drive. Nothing if the times do not increase, or if no unit fits.
/// `cells`: some rows from the beginning, `span`: last minus first time of the whole recording, in their unit.
std::optional<int> power_found(std::span<const double> times, double span);

}  // namespace astro::tables
