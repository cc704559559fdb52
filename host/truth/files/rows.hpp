#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/error.hpp"

/// Rows and cells of large tables, without a copy of any of them.
namespace astro::truth {

/// What is wrong with a recording. Values: the file; then, except for those up to no_pose, the line, the column if it is known,
/// and the text there. For units_differ the unit of the columns before comes first.
enum class TrackProblem {
  empty,
  unknown_form,
  older_motive,
  no_header,
  no_body,
  no_rigid_body,
  no_pose,
  length_unit_unknown,
  angle_unit_unknown,
  unit_of_other_quantity,
  units_differ,
  not_a_number,
  no_frame_number,
  no_time,
  time_not_increasing
};

/// Walks over the lines of a text: LF, CRLF or CR, with or without a byte order mark.
class Rows {
 public:
  /// Throws astro::Error if the text has a NUL byte (UTF-16, or no text at all).
  Rows(std::string_view text, std::string_view file);

  bool next();         // false after the last line
  bool next_filled();  // the same, past lines that hold nothing but separators
  std::string_view text() const { return line_; }
  int line() const { return number_; }  // from 1
  std::string_view file() const { return file_; }

  /// Whether the line holds nothing but blanks and separators.
  bool is_blank() const;

  /// Values of the error: the file, the line, the column (from 1), and `more`.
  [[noreturn]] void refuse(const std::string& what, Kind kind = {},
                           const std::vector<std::string>& more = {}) const;
  [[noreturn]] void refuse(int column, const std::string& what, Kind kind = {},
                           const std::vector<std::string>& more = {}) const;

 private:
  std::string_view rest_, file_, line_;
  char end_;
  int number_ = 0;
};

/// How a table is written.
struct Dialect {
  char separator = ',';  // ' ' stands for any number of blanks and tabs
  bool decimal_comma() const { return separator == ';'; }
};

/// The separator that a header row uses: the most frequent of , ; and tab outside of quotes, else blanks.
Dialect dialect_of(std::string_view line);

/// Takes the first cell off `rest`, without outer blanks and quotes. False if nothing is left.
bool take_cell(std::optional<std::string_view>& rest, char separator, std::string_view& cell);

/// All cells of a header row. More than 100 000 are refused.
std::vector<std::string_view> split_header(const Rows& rows, char separator);

/// A finite number; nothing if the cell is not one.
std::optional<double> cell_number(std::string_view cell, bool decimal_comma);

/// The cell for a message: 40 characters at most.
std::string cut_cell(std::string_view cell);
/// The same in quotes.
std::string shown_cell(std::string_view cell);

/// A time with all its digits: a decimal number, perhaps with an exponent, times 10^power in nanoseconds
/// (seconds: 9). Rounded to the nearest. Nothing if it is no number or does not fit into 63 bits.
std::optional<std::int64_t> exact_ns(std::string_view cell, int power, bool decimal_comma);

}  // namespace astro::truth
