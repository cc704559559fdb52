#pragma once

#include <string>

#include "host/base/byte_source.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// What is wrong with a table of wheels, or was left out of it. Values: the file, the line, and for a cell
/// its column and its text; but
///   rows_lost                        the file, how many places, the time of the first in seconds, and the
///                                    percentage of the travel that is missing
///   rows_incomplete, times_repeated  the file and how many rows
enum class WheelTableProblem {
  not_text,
  line_too_long,
  not_a_number,
  not_a_time,
  cell_empty,
  times_fall,
  too_few_rows,
  too_many_rows,
  rows_lost,
  rows_incomplete,
  times_repeated
};

/// What is known about a table of wheels besides its content.
struct WheelTable {
  /// The names of the columns (wheel_columns.hpp), such as "time_s,left_counts,right_counts", which replace
  /// those in the file. A name of any other kind, such as "-", marks a column that is not used.
  std::string columns;
  /// Each row is the travel since the row before, whatever the column names are.
  bool per_interval = false;
};

/// The wheels in a text table. Cells are separated by commas, semicolons, tabs or blanks. The first row has
/// the names of the columns unless they are given, and lines that begin with # are left out. Times are exact
/// to a nanosecond. A row in which one of the three cells is empty is left out and counted in a remark.
///
/// Errors  UnclearChoice (unclear_choice.hpp) with the names in the file if they do not identify the three
///         columns; astro::Error naming `name`, line and column for a cell that is not a finite number, for
///         times that fall, for empty cells or lost rows of travel per interval, and for a table of fewer
///         than two rows or of more than memory allows.
WheelTrack wheels_in_table(ByteSource& file, const std::string& name, const WheelTable& table = {});

}  // namespace astro::importing
