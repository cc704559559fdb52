#include "host/commands/shared/params_view.hpp"

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/base/text/columns.hpp"
#include "host/base/text/numbers.hpp"
#include "host/console/console.hpp"
#include "host/console/terminal.hpp"

namespace astro::commands {
namespace {

bool is_text(const robot::ParameterRow& row) { return row.kind == protocol::ParameterKind::text; }

// The robot's table does not carry the default of a text.
bool is_changed(const robot::ParameterRow& row) {
  return !is_text(row) && row.active.raw != row.default_value;
}

std::string limits(const robot::ParameterRow& row) {
  if (is_text(row)) return fmt::format("{} to {} characters", row.minimum, row.maximum);
  return fmt::format("{} to {}", robot::shortest(row, row.minimum), robot::shortest(row, row.maximum));
}

std::string unit(const robot::ParameterRow& row) { return row.unit == "1" ? "" : row.unit; }

}  // namespace

std::string plain(const robot::ParameterRow& row) {
  return is_text(row) ? row.active.text : robot::shortest(row, row.active.raw);
}

Json to_json(const robot::Value& value) {
  if (const double* real = std::get_if<double>(&value)) return *real;
  return std::get<std::string>(value);
}

Json to_json(const robot::ParameterRow& row) {
  Json json = {{"name", row.name},
               {"value", to_json(robot::to_value(row, row.active))},
               {"unit", row.unit},
               {"kind", std::string(protocol::name(row.kind))}};
  if (is_text(row)) {
    json["least_characters"] = row.minimum;
    json["most_characters"] = row.maximum;
  } else {
    json["default"] = robot::to_shortest(row, row.default_value);
    json["minimum"] = robot::to_shortest(row, row.minimum);
    json["maximum"] = robot::to_shortest(row, row.maximum);
    json["changed"] = is_changed(row);
  }
  json["doc"] = row.doc;
  return json;
}

std::string explanation(const robot::ParameterRow& row) {
  const std::string standard = is_text(row) ? "" : ", default " + robot::shortest(row, row.default_value);
  const std::string of = unit(row).empty() ? "" : unit(row) + ", ";
  return fmt::format("{}{}{}: {}", of, limits(row), standard, row.doc);
}

std::string parameter_table(const robot::RemoteParameters& robot, std::size_t columns) {
  std::vector<std::vector<std::string>> rows{{"", "name", "value", "unit", "limits", "meaning"}};
  for (const robot::ParameterRow& row : robot.rows())
    rows.push_back({is_changed(row) ? "*" : "", row.name, plain(row), unit(row), limits(row), row.doc});
  const std::string whole = console::table(rows, "llrlll");
  if (columns == 0) return whole;
  std::string text;
  for (std::size_t at = 0, end; (end = whole.find('\n', at)) != std::string::npos; at = end + 1) {
    const std::string line = whole.substr(at, end - at);
    const std::string head = clipped(line, columns);
    text += (head.size() == line.size() ? line : clipped(line, columns - 1) + "…") + '\n';
  }
  return text;
}

robot::Value parse_value(const robot::ParameterRow& row, const std::string& text) {
  if (is_text(row)) return text;
  const auto value = number_in(text.starts_with('+') ? std::string_view(text).substr(1) : text);
  if (!value)
    throw Error(fmt::format("{} = '{}' is not a number{}", row.name, text,
                            unit(row).empty() ? "" : " (in " + unit(row) + ", without writing the unit)"));
  return *value;
}

std::vector<robot::Change> staged_changes(const robot::RemoteParameters& robot) {
  std::vector<robot::Change> list;
  for (const robot::ParameterRow& row : robot.rows())
    if (row.staged != row.active)
      list.push_back(
          {row.name, row.unit, robot::to_value(row, row.active), robot::to_value(row, row.staged)});
  return list;
}

}  // namespace astro::commands
