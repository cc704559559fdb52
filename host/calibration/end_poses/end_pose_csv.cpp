#include "host/calibration/end_poses/end_pose_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "host/base/error.hpp"
#include "host/formats/tables/column_name.hpp"
#include "host/formats/tables/table.hpp"

namespace astro::calibration {
namespace {

/// An error of an end: its short name, and the words before "err" or "error".
struct EndError {
  std::string_view name;
  std::array<std::string_view, 2> words;
  tables::Quantity quantity;
  std::string_view spellings;
};
constexpr EndError kX{"ex", {"x", "x"}, tables::Quantity::length, "ex_mm or ex_cm or ex_m"};
constexpr EndError kY{"ey", {"y", "y"}, tables::Quantity::length, "ey_mm or ey_cm or ey_m"};
constexpr EndError kTheta{
    "etheta", {"heading", "theta"}, tables::Quantity::angle, "etheta_rad or etheta_deg"};

struct Column {
  std::size_t at = 0;
  std::string title;
  double to_si = 1;
};

enum class Naming { other, unclear, clear };

/// Whether a column is named as this error, or only as something about it that is not understood. A heading would be dropped
/// without a word then, because it may be left out; so each angle counts as one that may be meant.
Naming naming(const tables::ColumnName& title, const EndError& error) {
  const std::vector<std::string>& words = title.words;
  const bool is_short = !words.empty() && words[0] == error.name;
  const bool is_long = words.size() > 1 && (words[0] == error.words[0] || words[0] == error.words[1]) &&
                       (words[1] == "err" || words[1] == "error");
  if (is_short || is_long)
    return words.size() == (is_short ? 1 : 2) && title.unit && title.unit->quantity == error.quantity
               ? Naming::clear
               : Naming::unclear;
  const bool is_angle = error.quantity == tables::Quantity::angle &&
                        ((title.unit && title.unit->quantity == tables::Quantity::angle) ||
                         title.has({"etheta", "theta", "heading", "yaw"}));
  return is_angle ? Naming::unclear : Naming::other;
}

class EndPoses {
 public:
  EndPoses(std::string_view text, std::string_view name)
      : table_(text, name), x_(require(kX)), y_(require(kY)), theta_(find(kTheta)) {
    const std::vector<std::string>& titles = table_.names();
    for (std::size_t i = 0; i < titles.size(); ++i)
      if (tables::column_name(titles[i]).words == std::vector<std::string>{"direction"}) direction_ = i;
  }

  EndPoseTable read(std::optional<Sense> wanted) {
    EndPoseTable out;
    while (table_.next()) {
      if (out.poses.size() == kMostRuns)
        table_.rows().refuse("the table has more rows than anybody measures runs",
                             EndPoseTableProblem::too_many_rows);
      require_width();
      if (direction_) wanted = sense(*direction_, wanted, !out.poses.empty());
      EndPose pose{number(x_), number(y_), std::numeric_limits<double>::quiet_NaN()};
      if (theta_ && !table_.cell(theta_->at).empty()) pose.theta_rad = number(*theta_);
      out.poses.push_back(pose);
      out.lines.push_back(table_.rows().line());
    }
    if (out.poses.empty()) {
      const std::string name(table_.rows().file());
      throw Error(name + " has a header and no data rows: it needs one per run below it",
                  EndPoseTableProblem::no_rows, {name});
    }
    return out;
  }

 private:
  static constexpr std::size_t kMostRuns = 100'000;

  [[noreturn]] void refuse_header(const std::string& what, EndPoseTableProblem problem,
                                  const std::vector<std::string>& more) const {
    std::vector<std::string> values{std::string(table_.rows().file()),
                                    std::to_string(std::max(1, table_.line_of_names()))};
    values.insert(values.end(), more.begin(), more.end());
    throw Error(values[0] + ", line " + values[1] + ": " + what, problem, values);
  }

  std::optional<Column> find(const EndError& error) const {
    std::optional<Column> found;
    std::string unclear;
    for (std::size_t i = 0; i < table_.names().size(); ++i) {
      const std::string title = tables::cut_cell(table_.names()[i]);
      const tables::ColumnName name = tables::column_name(title);
      const Naming how = naming(name, error);
      if (how == Naming::unclear) unclear = title;
      if (how != Naming::clear) continue;
      if (found)
        refuse_header("columns " + found->title + " and " + title + " both give " + std::string(error.name) +
                          ": keep one of them",
                      EndPoseTableProblem::two_columns, {found->title, title});
      found = Column{i, title, name.unit->to_si};
    }
    if (!found && !unclear.empty())
      refuse_header(
          "column " + unclear + " is not named by error and unit, as " + std::string(error.spellings) + " is",
          EndPoseTableProblem::no_unit, {unclear});
    return found;
  }

  Column require(const EndError& error) const {
    if (auto found = find(error)) return *std::move(found);
    refuse_header("there is no column " + std::string(error.spellings), EndPoseTableProblem::no_column,
                  {std::string(error.name)});
  }

  /// A number that is cut in two by its decimal comma makes a row longer.
  void require_width() const {
    const std::size_t cells = table_.cells().size(), names = table_.names().size();
    if (cells <= names) return;
    const auto surplus = table_.cells().subspan(names);
    if (std::ranges::all_of(surplus, [](std::string_view cell) { return cell.empty(); })) return;
    const std::string has = std::to_string(cells), named = std::to_string(names);
    table_.rows().refuse("the row has " + has + " cells and the header " + named +
                             ": write numbers with a decimal point, or separate the cells by semicolons",
                         tables::TableProblem::rows_of_other_length, {has, named});
  }

  [[noreturn]] void refuse_cell(const Column& column, const std::string& what, EndPoseTableProblem problem,
                                std::vector<std::string> values) const {
    values.insert(values.begin(), column.title);
    table_.rows().refuse("column " + column.title + ": " + what, problem, values);
  }

  double number(const Column& column) const {
    const std::string_view cell = table_.cell(column.at);
    if (cell.empty())
      refuse_cell(column, "the cell is empty: write the number or leave the run out",
                  EndPoseTableProblem::empty_cell, {});
    const auto value = tables::cell_number(cell, table_.style());
    if (!value)
      refuse_cell(column, tables::shown_cell(cell) + " is not a number such as -12.5",
                  EndPoseTableProblem::not_a_number, {tables::cut_cell(cell)});
    return *value * column.to_si;
  }

  /// `wanted`: that of all runs, from the caller or, if there are any `before`, from these.
  Sense sense(std::size_t direction, std::optional<Sense> wanted, bool before) const {
    const std::string cell = tables::cut_cell(table_.cell(direction));
    const std::vector<std::string> words = tables::column_name(cell).words;
    const std::optional<Sense> sense = sense_named(words.size() == 1 ? words[0] : "");
    if (!sense)
      table_.rows().refuse("column direction: '" + cell + "' is not a direction, which is cw or ccw",
                           EndPoseTableProblem::no_direction, {cell});
    if (wanted && sense != wanted && before)
      table_.rows().refuse(
          "column direction: the file mixes cw and ccw runs where one direction is wanted: split it",
          EndPoseTableProblem::both_directions);
    if (wanted && sense != wanted)
      table_.rows().refuse("column direction: '" + cell + "', and this is the table of the " +
                               in_words(*wanted) + " runs: exchange the two tables, or correct the direction",
                           EndPoseTableProblem::other_direction, {cell});
    return *sense;
  }

  tables::Table table_;
  Column x_, y_;
  std::optional<Column> theta_;
  std::optional<std::size_t> direction_;
};

}  // namespace

EndPoseTable read_end_poses(std::string_view text, std::string_view name, std::optional<Sense> sense) {
  return EndPoses(text, name).read(sense);
}

}  // namespace astro::calibration
