#include "host/formats/tables/table.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "host/base/error.hpp"
#include "host/base/text/trimmed.hpp"
#include "host/formats/tables/time_column.hpp"
#include "host/formats/tables/times.hpp"
#include "host/formats/tables/units.hpp"

namespace astro::tables {
namespace {

constexpr std::size_t kLinesLookedAt = 60, kCellsLookedAt = 200;

/// The separator of "sep=;", which spreadsheets write and read as the first line.
std::optional<char> stated_separator(std::string_view line) {
  line = trimmed(line, "\"");
  if (line.size() == 5 && (line.starts_with("sep=") || line.starts_with("SEP="))) return line[4];
  return std::nullopt;
}

/// How well a separator explains some lines.
struct Fit {
  std::size_t columns = 0;  // of most lines
  double share = 0;         // of the cells that are values, times that of the lines with so many columns
};

Fit fit_of(char separator, std::string_view text, std::string_view file) {
  Rows rows(text, file);
  std::map<std::size_t, std::size_t> lines_with;
  std::vector<std::string_view> cells;
  std::size_t lines = 0, values = 0, all = 0;
  while (lines < kLinesLookedAt && rows.next_data()) {
    if (stated_separator(rows.text())) continue;
    split_row(rows, separator, cells);
    ++lines;
    ++lines_with[cells.size()];
    for (std::size_t i = 0; i < std::min(cells.size(), kCellsLookedAt); ++i) {
      ++all;
      values += is_value(cells[i], separator) || cells[i].empty() ? 1 : 0;
    }
  }
  Fit fit;
  std::size_t most = 0;
  for (const auto& [columns, count] : lines_with) {
    if (count < most) continue;
    most = count;
    fit.columns = columns;
  }
  if (fit.columns > 1)
    fit.share = static_cast<double>(values) / static_cast<double>(all) * static_cast<double>(most) /
                static_cast<double>(lines);
  return fit;
}

bool is_row(std::span<const std::string_view> cells, char separator) {
  std::size_t values = 0, filled = 0;
  for (const std::string_view cell : cells.first(std::min(cells.size(), kCellsLookedAt))) {
    if (cell.empty()) continue;
    ++filled;
    values += is_value(cell, separator) ? 1 : 0;
  }
  return values > 0 && 2 * values >= filled;
}

bool has_value(const auto& cells, char separator) {
  return std::ranges::any_of(cells, [=](std::string_view cell) { return is_value(cell, separator); });
}

std::string_view without_comment_mark(std::string_view line) {
  line = trimmed(line);
  while (!line.empty() && std::string_view("#%/ \t").find(line.front()) != std::string_view::npos)
    line.remove_prefix(1);
  return line;
}

bool are_units(std::span<const std::string_view> cells) {
  bool any = false;
  for (std::string_view cell : cells) {
    cell = trimmed(cell, " []()");
    if (cell.empty() || cell == "-") continue;
    if (!unit_named(cell)) return false;
    any = true;
  }
  return any;
}

}  // namespace

bool is_value(std::string_view cell, char separator) {
  return cell_number(cell, separator) || cell_number(cell, {separator, '.'}) || cell == "nan" ||
         cell == "NaN" || cell == "-nan" || written_time(cell);
}

Table::Table(std::string_view text, std::string_view file)
    : text_(text), file_(file), rows_(text, file), before_first_(rows_) {
  find_separator();
  find_names();
  if (names_.size() < 2 && columns_ > 1) {  // a title
    names_.clear();
    line_of_names_ = 0;
  }
  rewind();
  find_decimal_mark();
}

void Table::find_separator() {
  Rows rows = rows_;
  if (!rows.next_data())
    throw Error("'" + std::string(file_) + "' is empty", TextProblem::empty, {std::string(file_)});
  Fit best;
  if (const auto stated = stated_separator(rows.text())) {
    separator_ = *stated;
    best = fit_of(separator_, text_, file_);
  } else {
    // If two explain the lines equally well, the first is taken: tabs are in no cell, blanks and commas may be in many.
    for (const char separator : {'\t', ';', '|', ',', ' '})
      if (const Fit fit = fit_of(separator, text_, file_); fit.share > best.share) {
        best = fit;
        separator_ = separator;
      }
    if (separator_ == '\0') {
      separator_ = separator_of(rows.text());
      best.columns = split_row(rows, separator_).size();
    }
  }
  columns_ = best.columns;
}

void Table::find_names() {
  Rows rows = rows_;
  while (true) {
    const Rows before = rows;
    if (!rows.next_filled()) {
      // A table of names alone has no rows.
      before_first_ = before;
      return;
    }
    if (stated_separator(rows.text())) continue;
    if (rows.is_comment()) {
      take_names(rows, true);
      continue;
    }
    split_row(rows, separator_, cells_);
    // Most cells of a row may be words, but then the line of the names above it is as long and has no number.
    const bool follows_names = names_.size() == columns_ && cells_.size() == columns_ &&
                               !has_value(names_, separator_) && has_value(cells_, separator_);
    if (follows_names || is_row(cells_, separator_)) {
      before_first_ = before;
      return;
    }
    take_names(rows, false);
  }
}

/// A table has one decimal mark. If the cells leave it open, it is the one in the column of times, whose values are closer
/// together than those of counts.
void Table::find_decimal_mark() {
  constexpr std::size_t kRowsLookedAt = 2000;
  std::vector<MarksOfColumn> columns(std::min(std::max(columns_, names_.size()), kCellsLookedAt));
  for (std::size_t row = 0; row < kRowsLookedAt && next(); ++row)
    for (std::size_t i = 0; i < std::min(columns.size(), cells_.size()); ++i) columns[i].take(cells_[i]);
  rewind();
  const auto any = [&](bool (MarksOfColumn::*test)(char) const, char mark) {
    return std::ranges::any_of(columns, [&](const MarksOfColumn& one) { return (one.*test)(mark); });
  };
  const bool comma = any(&MarksOfColumn::shows, ','), point = any(&MarksOfColumn::shows, '.');
  if (comma != point) decimal_ = comma ? ',' : '.';
  if (comma || point || !any(&MarksOfColumn::may_have, ',') || !any(&MarksOfColumn::may_have, '.')) return;
  const auto time =
      std::ranges::find_if(names_, [](const std::string& name) { return time_name(name).has_value(); });
  const auto at = time == names_.end() ? 0 : static_cast<std::size_t>(time - names_.begin());
  if (at < columns.size() && columns[at].may_have(',') != columns[at].may_have('.'))
    decimal_ = columns[at].may_have(',') ? ',' : '.';
}

/// Each line above the rows may be that of the names; the last one is, unless it has units.
void Table::take_names(const Rows& line, bool comment) {
  std::vector<std::string_view> cells = cells_;
  if (comment) {
    std::optional<std::string_view> rest = without_comment_mark(line.text());
    cells.clear();
    for (std::string_view cell; cells.size() < columns_ + 1 && take_cell(rest, separator_, cell);)
      cells.push_back(cell);
    if (cells.size() != columns_ || is_row(cells, separator_)) return;  // a remark
  }
  if (!names_.empty() && cells.size() <= names_.size() && are_units(cells)) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (const std::string_view unit = trimmed(cells[i], " []()"); !unit.empty() && unit != "-")
        names_[i] += " [" + std::string(unit) + "]";
    return;
  }
  if (comment && !names_.empty() && line_of_names_ > 0 && names_.size() == columns_) return;
  names_.assign(cells.begin(), cells.end());
  line_of_names_ = line.line();
}

void Table::require_names() const {
  if (names_.empty() || columns_ <= names_.size()) return;
  Rows rows = before_first_;
  std::vector<std::string_view> cells;
  while (rows.next_data()) {
    split_row(rows, separator_, cells);
    if (cells.size() == columns_) break;
  }
  const auto surplus = std::span(cells).subspan(std::min(cells.size(), names_.size()));
  if (std::all_of(surplus.begin(), surplus.end(), [](std::string_view cell) { return cell.empty(); })) return;
  const std::string has = std::to_string(cells.size()), named = std::to_string(names_.size());
  rows.refuse("the row has " + has + " cells and the header " + named +
                  (separator_ == ',' ? ": are its numbers written with decimal commas? Save the table with "
                                       "semicolons or tabs between the cells"
                                     : ": give every column a name"),
              TableProblem::rows_of_other_length, {has, named});
}

bool Table::next() {
  if (!rows_.next_data()) {
    cells_.clear();
    return false;
  }
  split_row(rows_, separator_, cells_);
  return true;
}

void Table::rewind() { rows_ = before_first_; }

}  // namespace astro::tables
