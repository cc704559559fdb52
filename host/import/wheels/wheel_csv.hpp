#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// What is wrong with a table of wheels, or was left out of it. Values: the file, the line, and for a cell
/// its column and its text; but
///   rows_lost                        the file, how many places, the time of the first in seconds, and the
///                                    percentage of the travel that is missing
///   time_unit_unknown                the file and the column
///   rows_incomplete, times_repeated  the file and how many rows
///   times_continued                  the file, and after how many seconds its times start again
///   times_spread                     the file, how many rows each time has, and how many seconds the times are apart
///   times_too_coarse                 the file, and the percentage of the rows that repeat a time with other values
enum class WheelTableProblem {
  not_a_number,
  not_a_time,
  time_unit_unknown,
  cell_empty,
  times_fall,
  too_few_rows,
  too_many_rows,
  rows_lost,
  rows_incomplete,
  times_repeated,
  times_continued,
  times_spread,
  times_too_coarse
};

/// What is known about a table of wheels besides its content.
struct WheelTable {
  /// What the columns are (host/formats/tables/stated_columns.hpp), in the names of wheel_columns.hpp.
  std::string columns = {};
  /// Each row is the travel since the row before, whatever the column names are.
  bool per_interval = false;
  /// How many different counts a counter has before it starts again; nothing: found from the data.
  std::optional<double> counter_range = {};
};

/// The wheels in a text table (host/formats/tables/table.hpp), whose columns are those of wheel_columns.hpp. Times are exact
/// to a nanosecond. A row in which one of the cells is empty is left out and counted in a remark. Speeds are integrated; of
/// several wheels on a side the mean is taken, and a remark says by how much they differ. Rows that repeat the time of the row
/// above are left out if they are few; if they are many, because the times have too few digits, they are spread evenly. Remarks
/// say both.
///
/// Errors  UnclearChoice (unclear_choice.hpp) with the names in the file if they do not identify the columns; astro::Error
///         naming `name`, line and column for a cell that is not a finite number, for times that fall, naming `name` for
///         times that many rows repeat, but not evenly, for empty cells or
///         lost rows of travel per interval, and for a table of fewer than two rows or of more than memory allows; what
///         unwrap (counter_wraps.hpp) throws.
WheelTrack wheels_in_table(std::string_view text, const std::string& name, const WheelTable& table = {});

}  // namespace astro::importing
