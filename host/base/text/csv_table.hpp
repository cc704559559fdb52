#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/base/error.hpp"

namespace astro {

/// Why text is no table. Values: its name; the line (all but `empty` and not_plain_text) or the byte that is
/// zero, counted from 1 (not_plain_text); then the number of cells in the row and in the header
/// (row_of_other_length).
enum class CsvProblem {
  empty,
  not_plain_text,
  semicolons,
  open_quote,
  too_many_columns,
  too_many_cells,
  row_of_other_length
};

struct CsvRow {
  int line = 0;  // in the file, from 1
  std::vector<std::string> cells;
};

/// A header and rows that all have as many cells as it; cells without quotes and outer spaces.
struct CsvTable {
  CsvRow header;
  std::vector<CsvRow> rows;
};

/// Splits comma separated text. Accepted: a byte order mark, CRLF or CR line ends, blank lines, spaces round
/// a cell, quoted cells. Refused: an open quote, rows of other lengths, semicolons, text with a NUL byte in
/// it, more than 1000 columns, a table that would take more memory than 48 MiB plus twice its text.
CsvTable split_csv(std::string_view text, std::string_view name);

/// Throws astro::Error("NAME, line N: WHAT"). Its values are the name, the line and `more`.
[[noreturn]] void refuse(std::string_view name, int line, const std::string& what, Kind kind = {},
                         const std::vector<std::string>& more = {});

}  // namespace astro
