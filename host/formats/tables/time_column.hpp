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

/// Nothing if the name is not one of times: "time_s", "Timestamp (ms)", "stamp.sec", "millis", "__time", "t",
/// also in German, French, Spanish or Italian ("Zeit (ms)").
std::optional<TimeName> time_name(std::string_view text);

/// Where the times are. Whole seconds, dates or times of day, and the fraction of a second, may stand in two columns.
struct TimeColumns {
  std::optional<std::size_t> at, fraction;
  std::string stem;
  std::optional<int> power;  // stated by the name
  int fraction_power = 0;

  /// Takes the column of this name. False if it is another time than that which was taken before.
  bool take(std::size_t column, const TimeName& name);
  /// Drops `fraction` unless it holds fractions of the whole seconds that the other column holds. If both are whole times, the
  /// finer one stays. Leaves the table before its first row.
  void settle(Table& table);
};

/// The format of the times: dates or times of day, also below a name with a unit, or numbers, whose unit is that of the name or,
/// if it states none, follows from the rows. Nothing if neither shows it.
/// Precondition: `columns` has been settled. Leaves the table before its first row.
std::optional<TimeFormat> time_format(Table& table, const TimeColumns& columns);

/// Reads the times of successive rows. Times of day go on after midnight, and numbers after the end of 16 or 32 bits of
/// milliseconds or microseconds, as those of microcontrollers.
class TimeReader {
 public:
  TimeReader(const TimeColumns& columns, TimeFormat format, NumberStyle style)
      : columns_(columns), format_(format), style_(style) {}

  /// Nothing if the cell is no time of the format.
  std::optional<std::int64_t> read(std::string_view cell, std::string_view fraction = {});
  std::optional<std::int64_t> read(const Table& table);
  /// After how many seconds numbers started again, if they did.
  std::optional<double> started_again_s() const { return started_again_s_; }

 private:
  std::int64_t continued(std::int64_t time_ns);

  TimeColumns columns_;
  TimeFormat format_;
  NumberStyle style_;
  std::int64_t passed_ns_ = 0;
  std::optional<std::int64_t> last_;
  std::int64_t longest_ns_ = 0;  // step so far
  std::optional<double> started_again_s_;
};

}  // namespace astro::tables
