#pragma once

#include <string>

#include "host/base/byte_source.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// What is wrong with a table of wheels, or was left out of it. Values: the file, the line, and of a cell its
/// column and its text; but
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

/// What is known of a table of wheels besides the file.
struct WheelTable {
  /// "time_s,left_counts,right_counts": the names of the columns (wheel_columns.hpp), which take the place of those in
  /// the file; a name of any other kind, such as "-", stands for a column that is not used.
  std::string columns;
  /// Each row is the travel since the row before, whatever the names say.
  bool per_interval = false;
};

/// The wheels in a text table: cells between commas, semicolons, tabs or blanks, the names of the columns in the first
/// row unless they are given, lines that begin with # left out. Times are kept exact to a nanosecond. Rows with an empty
/// cell of the three are left out and counted in a remark.
///
/// Errors  UnclearChoice (unclear_choice.hpp) with the names in the file if they do not tell the three columns; astro::Error
///         naming `name`, line and column for anything else than a finite number, for times that do not rise, and for a
///         table of fewer than two rows or of more than can be held.
WheelTrack wheels_in_table(ByteSource& file, const std::string& name, const WheelTable& table = {});

}  // namespace astro::importing
