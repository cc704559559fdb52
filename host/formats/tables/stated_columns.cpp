#include "host/formats/tables/stated_columns.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/text/trimmed.hpp"

namespace astro::tables {
namespace {

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = text.find(',');
    parts.push_back(trimmed(text.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// The column of this name, or the only one that differs from it in nothing but case.
std::optional<std::size_t> column_of(std::string_view name, const std::vector<std::string>& names) {
  const auto exact = std::ranges::find(names, name);
  if (exact != names.end()) return static_cast<std::size_t>(exact - names.begin());
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (in_lower_case(names[i]) != in_lower_case(name)) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

}  // namespace

std::vector<std::string> names_with(std::string_view stated, const Table& table) {
  if (stated.empty()) return table.names();
  const std::string file(table.rows().file());
  const std::vector<std::string_view> parts = parts_of(stated);
  std::vector<std::string> names;
  if (stated.find('=') == std::string_view::npos) {
    names.assign(parts.begin(), parts.end());
    const std::size_t columns = std::max(table.columns(), table.names().size());
    if (names.size() > columns)
      throw Error("'" + file + "' has " + std::to_string(columns) + " columns, and " +
                      std::to_string(names.size()) + " names are given",
                  StatedColumnsProblem::too_many, {file, std::to_string(columns)});
    return names;
  }
  names.resize(table.names().size());
  for (const std::string_view part : parts) {
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos)
      throw Error("'" + std::string(part) + "' of '" + std::string(stated) +
                      "' does not say what the column is, as in COLUMN=time_s",
                  StatedColumnsProblem::no_meaning, {file, std::string(part)});
    const auto at = column_of(trimmed(part.substr(0, equals)), table.names());
    if (!at) {
      const std::string name(trimmed(part.substr(0, equals)));
      std::vector<std::string> values{file, name};
      std::string all;
      for (const std::string& one : table.names()) all += (all.empty() ? "" : ", ") + cut_cell(one);
      values.insert(values.end(), table.names().begin(), table.names().end());
      throw Error(
          "'" + file + "' has no column '" + name + "', but " + (all.empty() ? "no names at all" : all),
          StatedColumnsProblem::no_such_name, std::move(values));
    }
    names[*at] = trimmed(part.substr(equals + 1));
  }
  return names;
}

}  // namespace astro::tables
