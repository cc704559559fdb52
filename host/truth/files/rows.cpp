#include "host/truth/files/rows.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "host/base/error.hpp"
#include "host/base/text/trimmed.hpp"

namespace astro::truth {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF", kBlanks = " \t";
constexpr std::size_t kMostHeaderCells = 100'000, kMostShown = 40;

std::string_view without_quotes(std::string_view cell) {
  while (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = trimmed(cell.substr(1, cell.size() - 2), kBlanks);
  return cell;
}

/// Where the first cell of `text` ends. A separator within quotes does not count, unless the quote stays open.
std::size_t end_of_cell(std::string_view text, char separator) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin != std::string_view::npos && text[begin] == '"') {
    const std::size_t close = text.find('"', begin + 1);
    if (close != std::string_view::npos) return text.find(separator, close + 1);
  }
  return text.find(separator);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A decimal number taken apart: digits * 10^power. Digits that do not fit into 64 bits are dropped.
struct Decimal {
  std::uint64_t digits = 0;
  int power = 0;
  bool negative = false, any = false;
};

/// Takes digits with at most one point off `text`.
Decimal take_digits(std::string_view& text, char point) {
  Decimal out;
  bool fraction = false, full = false;
  for (; !text.empty(); text.remove_prefix(1)) {
    const char c = text.front();
    if (c == point && !fraction) {
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

}  // namespace

Rows::Rows(std::string_view text, std::string_view file) : rest_(text), file_(file) {
  if (rest_.substr(0, kUtf8Mark.size()) == kUtf8Mark) rest_.remove_prefix(kUtf8Mark.size());
  if (const std::size_t at = text.find('\0'); at != std::string_view::npos)
    throw Error(std::string(file) + " is not plain text: byte " + std::to_string(at + 1) +
                " is zero: save the table as comma separated UTF-8");
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

bool Rows::is_blank() const { return line_.find_first_not_of(" \t,;\"") == std::string_view::npos; }

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

Dialect dialect_of(std::string_view line) {
  std::size_t commas = 0, semicolons = 0, tabs = 0;
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    commas += c == ',';
    semicolons += c == ';';
    tabs += c == '\t';
  }
  if (semicolons > 0 && semicolons >= commas) return {';'};
  if (tabs > commas) return {'\t'};
  return {commas > 0 ? ',' : ' '};
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

std::vector<std::string_view> split_header(const Rows& rows, char separator) {
  std::vector<std::string_view> cells;
  std::optional<std::string_view> rest = rows.text();
  for (std::string_view cell; take_cell(rest, separator, cell);) {
    if (cells.size() == kMostHeaderCells)
      rows.refuse("the line has more than 100000 cells: this is no table of poses");
    cells.push_back(cell);
  }
  return cells;
}

std::optional<double> cell_number(std::string_view cell, bool decimal_comma) {
  char buffer[64];
  if (decimal_comma && cell.find(',') != std::string_view::npos) {
    if (cell.size() > sizeof buffer) return std::nullopt;
    std::replace_copy(cell.begin(), cell.end(), buffer, ',', '.');
    cell = {buffer, cell.size()};
  }
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (end != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  if (error == std::errc{}) return value;
  return std::nullopt;
}

std::string cut_cell(std::string_view cell) { return std::string(cell.substr(0, kMostShown)); }

std::string shown_cell(std::string_view cell) {
  return "'" + cut_cell(cell) + (cell.size() > kMostShown ? "...'" : "'");
}

std::optional<std::int64_t> exact_ns(std::string_view cell, int power, bool decimal_comma) {
  const bool negative = !cell.empty() && cell.front() == '-';
  if (negative || (!cell.empty() && cell.front() == '+')) cell.remove_prefix(1);
  const char point = decimal_comma && cell.find(',') != std::string_view::npos ? ',' : '.';
  Decimal decimal = take_digits(cell, point);
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

}  // namespace astro::truth
