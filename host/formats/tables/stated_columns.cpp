#include "host/formats/tables/stated_columns.hpp"

#include <algorithm>
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
    const std::string_view name = trimmed(part.substr(0, equals));
    const auto found = std::find(table.names().begin(), table.names().end(), name);
    if (found == table.names().end() || equals == std::string_view::npos) {
      std::vector<std::string> values{file, std::string(name)};
      values.insert(values.end(), table.names().begin(), table.names().end());
      throw Error("'" + file + "' has no column '" + std::string(name) + "'",
                  StatedColumnsProblem::no_such_name, std::move(values));
    }
    names[static_cast<std::size_t>(found - table.names().begin())] = trimmed(part.substr(equals + 1));
  }
  return names;
}

}  // namespace astro::tables
