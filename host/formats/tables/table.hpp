#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/formats/tables/rows.hpp"

namespace astro::tables {

/// Why rows and names do not belong together. Values: the file, the line, how many cells its row has and how many names there
/// are.
enum class TableProblem { rows_of_other_length };

/// A table with a row of names above, or without one. Finds by itself
///   - the separator: comma, semicolon, tab, bar or blanks, by what the cells are then; a line "sep=;" says it,
///   - the names: the last line before the rows that is no row, also a comment, and the units if they have a line of their own,
///   - which lines are comments (#, %, //) or stand above the table.
class Table {
 public:
  /// `text` must outlive it. Throws astro::Error if it is empty, and what Rows throws.
  Table(std::string_view text, std::string_view file);

  /// The names of the columns, with units that stand in a line of their own in brackets; empty if the table has none.
  const std::vector<std::string>& names() const { return names_; }
  /// The line with the names, or 0.
  int line_of_names() const { return line_of_names_; }
  /// The number of cells of most rows.
  std::size_t columns() const { return columns_; }
  char separator() const { return separator_; }
  /// With the decimal mark, if the cells show it.
  NumberStyle style() const { return {separator_, decimal_}; }

  /// The next row; false after the last.
  bool next();
  std::span<const std::string_view> cells() const { return cells_; }
  /// "" beyond the end of the row.
  std::string_view cell(std::size_t at) const { return at < cells_.size() ? cells_[at] : std::string_view(); }
  const Rows& rows() const { return rows_; }

  /// Throws astro::Error if the rows have more cells than there are names, as where decimal commas separate cells.
  void require_names() const;

  /// Goes back before the first row.
  void rewind();

 private:
  void find_separator();
  void find_names();
  void take_names(const Rows& line, bool comment);
  void find_decimal_mark();

  std::string_view text_, file_;
  Rows rows_, before_first_;
  std::vector<std::string_view> cells_;
  std::vector<std::string> names_;
  std::size_t columns_ = 0;
  int line_of_names_ = 0;
  char separator_ = '\0', decimal_ = '\0';
};

/// Whether a cell is a number, NaN or a written time: what stands in rows and not above them.
bool is_value(std::string_view cell, char separator);

}  // namespace astro::tables
