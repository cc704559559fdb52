#include "host/calibration/end_poses/end_pose_csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "host/base/error.hpp"
#include "host/base/text/csv_table.hpp"
#include "host/base/text/degrees.hpp"

namespace astro::calibration {
namespace {

struct Unit {
  std::string_view suffix;
  double to_si;
};
constexpr std::array kLengths{Unit{"mm", 1e-3}, Unit{"cm", 1e-2}, Unit{"m", 1.0}};
constexpr std::array kAngles{Unit{"rad", 1.0}, Unit{"deg", radians(1)}};

struct Quantity {
  std::string_view name, alias;
  std::span<const Unit> units;
};
constexpr Quantity kX{"ex", "x_err", kLengths};
constexpr Quantity kY{"ey", "y_err", kLengths};
constexpr Quantity kTheta{"etheta", "heading_err", kAngles};

struct Column {
  std::size_t index = 0;
  std::string title;
  double to_si = 1;
};

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

/// "ex_mm or ex_cm or ex_m"
std::string spellings(const Quantity& quantity) {
  std::string out;
  for (const Unit& unit : quantity.units) {
    out += (out.empty() ? "" : " or ") + std::string(quantity.name) + "_" + std::string(unit.suffix);
  }
  return out;
}

std::optional<double> factor_of(const std::string& title, const Quantity& quantity) {
  for (const std::string_view name : {quantity.name, quantity.alias}) {
    for (const Unit& unit : quantity.units) {
      if (title == std::string(name) + "_" + std::string(unit.suffix)) return unit.to_si;
    }
  }
  return std::nullopt;
}

/// Whether a title names the quantity without a known unit: "ex", "ex_inch", "ex [mm]".
bool lacks_unit(const std::string& title, const Quantity& quantity) {
  for (const std::string_view name : {quantity.name, quantity.alias}) {
    if (!title.starts_with(name)) continue;
    if (title.size() == name.size() ||
        std::string_view("_ [(").find(title[name.size()]) != std::string_view::npos) {
      return true;
    }
  }
  return false;
}

std::optional<Column> find_column(const CsvTable& table, const Quantity& quantity, std::string_view name) {
  std::optional<Column> found;
  std::string unitless;
  for (std::size_t i = 0; i < table.header.cells.size(); ++i) {
    const std::string& title = table.header.cells[i];
    if (const auto to_si = factor_of(lower_case(title), quantity)) {
      if (found) {
        refuse(name, table.header.line,
               "columns " + found->title + " and " + title + " both give " + std::string(quantity.name) +
                   ": keep one of them",
               EndPoseTableProblem::two_columns, {found->title, title});
      }
      found = Column{i, title, *to_si};
    } else if (lacks_unit(lower_case(title), quantity)) {
      unitless = title;
    }
  }
  if (!found && !unitless.empty()) {
    refuse(name, table.header.line,
           "column " + unitless + " does not say its unit, as " + spellings(quantity) + " does",
           EndPoseTableProblem::no_unit, {unitless});
  }
  return found;
}

Column require_column(const CsvTable& table, const Quantity& quantity, std::string_view name) {
  if (const auto found = find_column(table, quantity, name)) return *found;
  refuse(name, table.header.line, "there is no column " + spellings(quantity), EndPoseTableProblem::no_column,
         {std::string(quantity.name)});
}

double number(const CsvRow& row, const Column& column, std::string_view name) {
  const std::string& cell = row.cells[column.index];
  const std::string where = "column " + column.title + ": ";
  if (cell.empty())
    refuse(name, row.line, where + "the cell is empty: write the number or leave the run out",
           EndPoseTableProblem::empty_cell, {column.title});
  const char* const end = cell.data() + cell.size();
  // from_chars, because unlike strtod it does not depend on the locale. It accepts no plus sign, which a
  // spreadsheet may write.
  const char* const begin = cell.data() + (cell[0] == '+' && cell.size() > 1 && cell[1] != '-' ? 1 : 0);
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::invalid_argument || stop != end) {
    refuse(name, row.line, where + "\"" + cell + "\" is not a number such as -12.5",
           EndPoseTableProblem::not_a_number, {column.title, cell});
  }
  if (error != std::errc{} || !std::isfinite(value)) {
    refuse(name, row.line,
           where + "\"" + cell + "\" is not a finite number: measure it again or leave the run out",
           EndPoseTableProblem::not_finite, {column.title, cell});
  }
  return value * column.to_si;
}

struct Columns {
  Column x, y;
  std::optional<Column> theta;
  std::optional<std::size_t> direction;
};

Columns find_columns(const CsvTable& table, std::string_view name) {
  Columns out{
      require_column(table, kX, name), require_column(table, kY, name), find_column(table, kTheta, name), {}};
  for (std::size_t i = 0; i < table.header.cells.size(); ++i) {
    if (lower_case(table.header.cells[i]) == "direction") out.direction = i;
  }
  if (table.rows.empty()) {
    throw Error(std::string(name) + " has a header and no data rows: it needs one per run below it",
                EndPoseTableProblem::no_rows, {std::string(name)});
  }
  return out;
}

EndPose pose(const CsvRow& row, const Columns& columns, std::string_view name) {
  EndPose out{number(row, columns.x, name), number(row, columns.y, name),
              std::numeric_limits<double>::quiet_NaN()};
  if (columns.theta && !row.cells[columns.theta->index].empty())
    out.theta_rad = number(row, *columns.theta, name);
  return out;
}

Sense sense_of(const CsvRow& row, std::size_t direction, std::string_view name) {
  const std::optional<Sense> sense = sense_named(lower_case(row.cells[direction]));
  if (!sense) {
    refuse(name, row.line,
           "column direction: \"" + row.cells[direction] + "\" is not a direction, which is cw or ccw",
           EndPoseTableProblem::no_direction, {row.cells[direction]});
  }
  return *sense;
}

}  // namespace

EndPoseTable read_end_poses(std::string_view text, std::string_view name, std::optional<Sense> sense) {
  const CsvTable table = split_csv(text, name);
  const Columns columns = find_columns(table, name);
  EndPoseTable out;
  for (const CsvRow& row : table.rows) {
    const auto direction = columns.direction;
    if (direction && sense_of(row, *direction, name) != sense_of(table.rows[0], *direction, name)) {
      refuse(name, row.line,
             "column direction: the file mixes cw and ccw runs where one direction is wanted: split it",
             EndPoseTableProblem::both_directions);
    }
    if (direction && sense && sense_of(row, *direction, name) != *sense)
      refuse(name, row.line,
             "column direction: \"" + row.cells[*direction] + "\", and this is the table of the " +
                 in_words(*sense) + " runs: exchange the two tables, or correct the direction",
             EndPoseTableProblem::other_direction, {row.cells[*direction]});
    out.poses.push_back(pose(row, columns, name));
    out.lines.push_back(row.line);
  }
  return out;
}

}  // namespace astro::calibration
