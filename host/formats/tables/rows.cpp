#include "host/formats/tables/rows.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "host/base/error.hpp"
#include "host/base/text/trimmed.hpp"

namespace astro::tables {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF", kBlanks = " \t";
constexpr std::size_t kMostCells = 100'000, kMostShown = 40, kLongestNumber = 64;

std::string_view without_quotes(std::string_view cell) {
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = trimmed(cell.substr(1, cell.size() - 2), kBlanks);
  return cell;
}

/// Where the first cell of `text` ends. A separator within quotes does not count, unless the quote stays open.
std::size_t end_of_cell(std::string_view text, char separator) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin != std::string_view::npos && text[begin] == '"') {
    // A doubled quote is one that the cell holds.
    std::size_t close = text.find('"', begin + 1);
    while (close != std::string_view::npos && text.substr(close + 1, 1) == "\"")
      close = text.find('"', close + 2);
    if (close != std::string_view::npos) return text.find(separator, close + 1);
  }
  return text.find(separator);
}

/// A decimal number taken apart: digits * 10^power. Digits that do not fit into 64 bits are dropped.
struct Decimal {
  std::uint64_t digits = 0;
  int power = 0;
  bool negative = false, any = false;
};

/// Takes digits with at most one point off `text`.
Decimal take_digits(std::string_view& text) {
  Decimal out;
  bool fraction = false, full = false;
  for (; !text.empty(); text.remove_prefix(1)) {
    const char c = text.front();
    if (c == '.' && !fraction) {
      fraction = true;
      continue;
    }
    if (!is_digit(c)) break;
    out.any = true;
    full = full || out.digits > (std::numeric_limits<std::uint64_t>::max() - 9) / 10;
    if (!full) out.digits = out.digits * 10 + static_cast<std::uint64_t>(c - '0');
    if (full && !fraction && out.power < 100) ++out.power;
    if (!full && fraction && out.power > -1000) --out.power;
  }
  return out;
}

/// Whether `mark` stands only between groups of three digits, as in 12,345,678.
bool groups_digits(std::string_view whole, char mark) {
  if (whole.starts_with('-') || whole.starts_with('+')) whole.remove_prefix(1);
  std::size_t group = whole.find(mark);
  if (group == std::string_view::npos || group == 0 || group > 3 || whole.front() == '0') return false;
  for (std::string_view rest = whole.substr(group); !rest.empty(); rest.remove_prefix(4)) {
    if (rest.size() < 4 || rest.front() != mark) return false;
    if (!std::all_of(rest.begin() + 1, rest.begin() + 4, is_digit)) return false;
  }
  return std::all_of(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(group), is_digit);
}

/// Marks that only group digits: a blank, one that does not break the line, wide or narrow, or an apostrophe.
constexpr std::string_view kGroupMarks[] = {" ",           "'", "\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89",
                                            "\xE2\x80\x99"};

/// The number without marks that only group digits; the cell itself if it has none, and "" if they do not stand between groups.
/// `buffer` holds the result.
std::string_view without_group_marks(std::string_view cell, std::span<char> buffer) {
  if (cell.find_first_of(" '\xC2\xE2") == std::string_view::npos) return cell;
  if (cell.size() > buffer.size()) return {};
  std::size_t size = 0;
  while (!cell.empty()) {
    const auto* const mark = std::find_if(std::begin(kGroupMarks), std::end(kGroupMarks),
                                          [&](std::string_view one) { return cell.starts_with(one); });
    const bool is_mark = mark != std::end(kGroupMarks);
    buffer[size++] = is_mark ? '\'' : cell.front();
    cell.remove_prefix(is_mark ? mark->size() : 1);
  }
  const std::string_view marked(buffer.data(), size);
  if (!groups_digits(marked.substr(0, marked.find_first_of(".,")), '\'')) return {};
  return {buffer.data(),
          static_cast<std::size_t>(
              std::remove(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size), '\'') -
              buffer.begin())};
}

/// The mark before the fraction, or '\0' if the number has none; nothing if the marks make no number, or if it can be either.
std::optional<char> decimal_mark(std::string_view cell, NumberStyle style) {
  const std::size_t comma = cell.rfind(','), point = cell.rfind('.');
  if (comma == std::string_view::npos && point == std::string_view::npos) return '\0';
  if (comma != std::string_view::npos && point != std::string_view::npos) {
    const char decimal = point > comma ? '.' : ',';
    if (!groups_digits(cell.substr(0, std::max(comma, point)), other_mark(decimal))) return std::nullopt;
    return decimal;
  }
  const char mark = comma == std::string_view::npos ? '.' : ',';
  if (!groups_digits(cell, mark)) return mark;
  if (cell.find(mark) != cell.rfind(mark)) return '\0';
  if (style.decimal != '\0') return style.decimal == mark ? mark : '\0';
  if (mark == ',' && style.separator == ',') return std::nullopt;
  return mark;
}

/// The number with a decimal point and without marks between groups of digits; "" if a mark in it can be either. Uses `buffer`
/// if something has to be changed.
std::string_view with_decimal_point(std::string_view cell, NumberStyle style, std::span<char> buffer) {
  cell = without_group_marks(cell, buffer);
  if (cell.find_first_of(",.") == std::string_view::npos) return cell;
  const auto decimal = decimal_mark(cell, style);
  if (!decimal || cell.size() > buffer.size()) return {};
  std::size_t size = 0;
  for (const char c : cell) {
    if ((c == ',' || c == '.') && c != *decimal) continue;
    buffer[size++] = c == ',' ? '.' : c;
  }
  return {buffer.data(), size};
}

}  // namespace

Rows::Rows(std::string_view text, std::string_view file) : rest_(text), file_(file) {
  if (rest_.substr(0, kUtf8Mark.size()) == kUtf8Mark) rest_.remove_prefix(kUtf8Mark.size());
  if (const std::size_t at = text.find('\0'); at != std::string_view::npos)
    throw Error(std::string(file) + " is not plain text: byte " + std::to_string(at + 1) +
                    " is zero: save the table as comma separated UTF-8",
                TextProblem::not_plain_text, {std::string(file), std::to_string(at + 1)});
  end_ = rest_.find('\n') == std::string_view::npos ? '\r' : '\n';
}

bool Rows::next() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find(end_);
  line_ = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
  while (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  ++number_;
  return true;
}

bool Rows::next_filled() {
  while (next()) {
    if (!is_blank()) return true;
  }
  return false;
}

bool Rows::next_data() {
  while (next_filled()) {
    if (!is_comment()) return true;
  }
  return false;
}

bool Rows::is_comment() const {
  const std::string_view text = trimmed(line_, " \t\"");
  return text.starts_with('#') || text.starts_with('%') || text.starts_with("//");
}

bool Rows::is_blank() const { return line_.find_first_not_of(" \t,;|\"") == std::string_view::npos; }

void Rows::refuse(const std::string& what, Kind kind, const std::vector<std::string>& more) const {
  std::vector<std::string> values{std::string(file_), std::to_string(number_)};
  values.insert(values.end(), more.begin(), more.end());
  throw Error(values[0] + ", line " + values[1] + ": " + what, kind, values);
}

void Rows::refuse(int column, const std::string& what, Kind kind,
                  const std::vector<std::string>& more) const {
  std::vector<std::string> values{std::string(file_), std::to_string(number_), std::to_string(column)};
  values.insert(values.end(), more.begin(), more.end());
  throw Error(values[0] + ", line " + values[1] + ", column " + values[2] + ": " + what, kind, values);
}

char separator_of(std::string_view line) {
  std::size_t commas = 0, semicolons = 0, tabs = 0;
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    commas += c == ',';
    semicolons += c == ';';
    tabs += c == '\t';
  }
  if (semicolons > 0 && semicolons >= commas) return ';';
  if (tabs > commas) return '\t';
  return commas > 0 ? ',' : ' ';
}

bool take_cell(std::optional<std::string_view>& rest, char separator, std::string_view& cell) {
  if (!rest) return false;
  std::size_t end = 0;
  if (separator == ' ') {
    *rest = trimmed(*rest, kBlanks);
    if (rest->empty()) return false;
    end = rest->find_first_of(" \t");
  } else {
    end = end_of_cell(*rest, separator);
  }
  cell = without_quotes(trimmed(rest->substr(0, end), kBlanks));
  if (end == std::string_view::npos) {
    rest.reset();
  } else {
    rest->remove_prefix(end + 1);
  }
  return true;
}

void split_row(const Rows& rows, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  std::optional<std::string_view> rest = rows.text();
  for (std::string_view cell; take_cell(rest, separator, cell);) {
    if (cells.size() == kMostCells)
      rows.refuse("the line has more than 100000 cells: this is no table of drives",
                  TextProblem::too_many_cells);
    cells.push_back(cell);
  }
}

std::vector<std::string_view> split_row(const Rows& rows, char separator) {
  std::vector<std::string_view> cells;
  split_row(rows, separator, cells);
  return cells;
}

std::optional<double> cell_number(std::string_view cell, NumberStyle style) {
  std::array<char, kLongestNumber> buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): written first
  cell = with_decimal_point(cell, style, buffer);
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

void MarksOfColumn::take(std::string_view cell) {
  std::array<char, kLongestNumber> buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): written first
  cell = without_group_marks(cell, buffer);
  const std::size_t comma = cell.rfind(','), point = cell.rfind('.');
  if (comma == std::string_view::npos && point == std::string_view::npos) {
    plain_ = plain_ || (!cell.empty() && std::all_of(cell.begin(), cell.end(), is_digit));
    return;
  }
  if (comma != std::string_view::npos && point != std::string_view::npos) {
    const auto decimal = decimal_mark(cell, {});
    if (decimal) (*decimal == ',' ? comma_ : point_).decimal = true;
    return;
  }
  Mark& mark = comma == std::string_view::npos ? point_ : comma_;
  const char c = comma == std::string_view::npos ? '.' : ',';
  if (!groups_digits(cell, c)) {
    mark.decimal = mark.decimal || std::all_of(cell.begin(), cell.end(), [](char one) {
                     return is_digit(one) || std::string_view(".,+-eE").find(one) != std::string_view::npos;
                   });
    return;
  }
  mark.either = true;
  mark.groups = mark.groups || cell.find(c) != cell.rfind(c);
  mark.ends_in_zero = mark.ends_in_zero || cell.back() == '0';
}

bool MarksOfColumn::shows(char decimal) const {
  const Mark &own = decimal == ',' ? comma_ : point_, &other = decimal == ',' ? point_ : comma_;
  // A fixed number of decimals is never left out, and a shortest one does not end in zero: the mark groups.
  return own.decimal || (!other.decimal && (other.groups || (plain_ && other.either && other.ends_in_zero)));
}

bool MarksOfColumn::may_have(char decimal) const { return (decimal == ',' ? comma_ : point_).either; }

std::string cut_cell(std::string_view cell) { return std::string(cell.substr(0, kMostShown)); }

std::string shown_cell(std::string_view cell) {
  return "'" + cut_cell(cell) + (cell.size() > kMostShown ? "...'" : "'");
}

std::optional<std::int64_t> exact_ns(std::string_view cell, int power, NumberStyle style) {
  std::array<char, kLongestNumber> buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): written first
  cell = with_decimal_point(cell, style, buffer);
  const bool negative = !cell.empty() && cell.front() == '-';
  if (negative || (!cell.empty() && cell.front() == '+')) cell.remove_prefix(1);
  Decimal decimal = take_digits(cell);
  if (!decimal.any) return std::nullopt;
  int exponent = 0;
  if (!cell.empty()) {
    if (cell.front() != 'e' && cell.front() != 'E') return std::nullopt;
    cell.remove_prefix(1);
    if (cell.size() > 1 && cell.front() == '+' && is_digit(cell[1])) cell.remove_prefix(1);
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), exponent);
    if (error != std::errc{} || end != cell.data() + cell.size() || std::abs(exponent) > 2000)
      return std::nullopt;
  }
  int shift = decimal.power + exponent + power;
  for (; shift > 0 && decimal.digits > 0; --shift) {
    if (decimal.digits > std::numeric_limits<std::int64_t>::max() / 10) return std::nullopt;
    decimal.digits *= 10;
  }
  bool half = false;
  for (; shift < 0 && (decimal.digits > 0 || half); ++shift) {
    half = decimal.digits % 10 >= 5;
    decimal.digits /= 10;
  }
  decimal.digits += half ? 1 : 0;
  // The offset between two clocks must fit as well, so a quarter of the range is left free.
  if (decimal.digits > std::numeric_limits<std::int64_t>::max() / 4) return std::nullopt;
  const auto ns = static_cast<std::int64_t>(decimal.digits);
  return negative ? -ns : ns;
}

}  // namespace astro::tables
