#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/error.hpp"

/// Rows and cells of large tables, without a copy of any of them.
namespace astro::tables {

/// Why text is no table. Values: the file; then the byte that is zero, counted from 1 (not_plain_text), or the line
/// (too_many_cells).
enum class TextProblem { empty, not_plain_text, too_many_cells };

/// Walks over the lines of a text: LF, CRLF or CR, with or without a byte order mark.
class Rows {
 public:
  /// Throws astro::Error if the text has a NUL byte.
  Rows(std::string_view text, std::string_view file);

  bool next();         // false after the last line
  bool next_filled();  // the same, past lines that hold nothing but separators
  bool next_data();    // the same, and past comments
  std::string_view text() const { return line_; }
  int line() const { return number_; }  // from 1
  std::string_view file() const { return file_; }

  /// Whether the line holds nothing but blanks and separators.
  bool is_blank() const;
  /// Whether it begins with #, % or //.
  bool is_comment() const;

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

/// The separator that a row uses: the most frequent of , ; and tab outside of quotes, else ' ', which stands for any number of
/// blanks and tabs.
char separator_of(std::string_view line);

/// Takes the first cell off `rest`, without outer blanks and quotes. False if nothing is left.
bool take_cell(std::optional<std::string_view>& rest, char separator, std::string_view& cell);

/// All cells of a row into `cells`. Throws astro::Error for more than 100 000.
void split_row(const Rows& rows, char separator, std::vector<std::string_view>& cells);
std::vector<std::string_view> split_row(const Rows& rows, char separator);

/// How the numbers of a table are written.
struct NumberStyle {
  char separator = ',';
  char decimal = '\0';  // the mark before fractions, if the table shows it

  constexpr NumberStyle() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a separator is all that most formats have
  constexpr NumberStyle(char between, char before_fractions = '\0')
      : separator(between), decimal(before_fractions) {}
};

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr char other_mark(char mark) { return mark == ',' ? '.' : ','; }

/// A finite number; nothing if the cell is not one. A comma is a decimal comma, as in "0,5" and "1.234,5", or groups digits,
/// as in "1,234.5"; blanks and apostrophes group digits. "1,250" and "1.250" are read by the decimal mark of the table; without
/// one, what stands there is a decimal mark, but a comma in a table that is separated by commas may be either, and is none.
std::optional<double> cell_number(std::string_view cell, NumberStyle style);

/// What the numbers in a column show of the decimal mark.
class MarksOfColumn {
 public:
  void take(std::string_view cell);
  /// Whether this mark stands before fractions, or the other one groups digits.
  bool shows(char decimal) const;
  /// Whether this mark stands where it can be either.
  bool may_have(char decimal) const;

 private:
  struct Mark {
    bool decimal = false, either = false, groups = false, ends_in_zero = false;
  };
  Mark comma_, point_;
  bool plain_ = false;  // some whole numbers have no mark
};

/// The cell for a message: 40 characters at most.
std::string cut_cell(std::string_view cell);
/// The same in quotes.
std::string shown_cell(std::string_view cell);

/// A time with all its digits: a decimal number, perhaps with an exponent, times 10^power in nanoseconds
/// (seconds: 9). Rounded to the nearest. Nothing if it is no number or does not fit into 61 bits.
std::optional<std::int64_t> exact_ns(std::string_view cell, int power, NumberStyle style);

}  // namespace astro::tables
