#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/formats/tables/table.hpp"
#include "host/formats/tables/times.hpp"

/// The times of the rows of a table.
namespace astro::tables {

/// What a name says of a column of times.
struct TimeName {
  std::string stem;  // the words without the unit: "header.stamp"
  std::optional<int> power;
};

/// Nothing if the name is not one of times: "time_s", "Timestamp (ms)", "stamp.sec", "millis", "__time", "t".
std::optional<TimeName> time_name(std::string_view text);

/// Where the times are. Whole seconds and nanoseconds may stand in two columns.
struct TimeColumns {
  std::optional<std::size_t> at, nanoseconds;
  std::string stem;
  std::optional<int> power;  // stated by the name

  /// Takes the column of this name. False if it is another time than that which was taken before.
  bool take(std::size_t column, const TimeName& name);
};

/// The format of the times, from their names or, if these state no unit, from the rows. Nothing if neither shows it.
/// Precondition: `columns.at`. Leaves the table before its first row.
std::optional<TimeFormat> time_format(Table& table, const TimeColumns& columns);

/// Reads the times of successive rows. Times of day go on after midnight.
class TimeReader {
 public:
  TimeReader(const TimeColumns& columns, TimeFormat format, char separator)
      : columns_(columns), format_(format), separator_(separator) {}

  /// Nothing if the cell is no time of the format.
  std::optional<std::int64_t> read(std::string_view cell, std::string_view nanoseconds = {});
  std::optional<std::int64_t> read(const Table& table);

 private:
  TimeColumns columns_;
  TimeFormat format_;
  char separator_;
  std::int64_t days_ns_ = 0;
  std::optional<std::int64_t> last_;
};

}  // namespace astro::tables
