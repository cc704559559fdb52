#include "host/truth/files/motive_header.hpp"

#include <algorithm>

#include "host/base/error.hpp"

namespace astro::truth {
namespace {

using HeaderCells = std::vector<std::string_view>;

constexpr std::size_t kMostHeadingRows = 16;

std::string_view at_or_empty(const HeaderCells& cells, std::size_t index) {
  return index < cells.size() ? cells[index] : std::string_view{};
}

[[noreturn]] void refuse_without_header(const Rows& rows) {
  throw Error(
      "'" + std::string(rows.file()) +
          "' has no header of Motive with a row that begins with Frame, so its columns have no meaning: "
          "export the recording again with its header",
      TrackProblem::no_header, {std::string(rows.file())});
}

void read_values(const HeaderCells& cells, MotiveHeader& out) {
  for (std::size_t i = 0; i + 1 < std::min<std::size_t>(cells.size(), 64); i += 2) {
    if (!cells[i].empty()) out.values.try_emplace(std::string(cells[i]), cells[i + 1]);
  }
}

/// The heading rows above the row that begins with Frame.
struct Headings {
  HeaderCells type, name, id, kind, axis;
};

/// A row by its label in the second cell, or by its place where the version has no labels.
const HeaderCells& labelled(const std::vector<HeaderCells>& rows, std::string_view label, std::size_t place) {
  static const HeaderCells kNone;
  for (const HeaderCells& row : rows) {
    if (at_or_empty(row, 1) == label) return row;
  }
  const bool labels = !rows.empty() && at_or_empty(rows.front(), 1) == "Type";
  return !labels && place < rows.size() ? rows[place] : kNone;
}

Headings read_headings(Rows& rows, char separator) {
  std::vector<HeaderCells> above;
  Headings out;
  while (rows.next_filled() && above.size() <= kMostHeadingRows) {
    HeaderCells cells = split_header(rows, separator);
    if (at_or_empty(cells, 0) != "Frame") {
      above.push_back(std::move(cells));
      continue;
    }
    out.axis = std::move(cells);
    out.type = labelled(above, "Type", 0);
    out.name = labelled(above, "Name", 1);
    out.id = labelled(above, "ID", 2);
    for (const HeaderCells& row : above) {
      if (std::find(row.begin(), row.end(), "Position") != row.end()) out.kind = row;
    }
    return out;
  }
  refuse_without_header(rows);
}

/// Where the cell of a rigid body belongs; nullptr if it is neither a position nor a rotation.
int* place_of(MotiveBody& body, std::string_view kind, std::string_view axis) {
  const std::size_t index =
      axis.size() == 1 ? std::string_view("XYZW").find(axis[0]) : std::string_view::npos;
  if (kind == "Position" && index < 3) return &body.position[index];
  if (kind == "Rotation" && index < 4) return &body.rotation[index];
  return nullptr;
}

std::vector<MotiveBody> bodies_of(const Headings& headings) {
  std::vector<MotiveBody> bodies;
  bool within = false;
  for (std::size_t i = 0; i < headings.type.size(); ++i) {
    if (headings.type[i] != "Rigid Body") {
      within = false;
      continue;
    }
    const std::string_view name = at_or_empty(headings.name, i), id = at_or_empty(headings.id, i);
    const std::string_view kind = at_or_empty(headings.kind, i), axis = at_or_empty(headings.axis, i);
    within = within && bodies.back().name.name == name && bodies.back().name.id == id;
    if (within) {
      const int* taken = place_of(bodies.back(), kind, axis);
      within = taken == nullptr || *taken < 0;
    }
    if (!within) bodies.push_back({{std::string(name), std::string(id)}});
    within = true;
    if (int* place = place_of(bodies.back(), kind, axis)) *place = static_cast<int>(i);
  }
  return bodies;
}

void find_fixed_columns(const HeaderCells& axis, MotiveHeader& out) {
  for (std::size_t i = 1; i < std::min<std::size_t>(axis.size(), 3); ++i) {
    if (axis[i].substr(0, 4) != "Time") continue;
    (axis[i] == "TimeCode" ? out.time_code_column : out.time_column) = static_cast<int>(i);
  }
}

}  // namespace

std::string MotiveHeader::value(std::string_view key) const {
  const auto found = values.find(key);
  return found == values.end() ? "" : found->second;
}

double MotiveHeader::number(std::string_view key) const {
  const auto number = cell_number(value(key), dialect.decimal_comma());
  return number && *number > 0 ? *number : 0;
}

MotiveHeader read_motive_header(Rows& rows) {
  if (!rows.next_filled())
    throw Error("'" + std::string(rows.file()) + "' is empty", TrackProblem::empty,
                {std::string(rows.file())});
  MotiveHeader out;
  out.dialect = dialect_of(rows.text());
  const HeaderCells first = split_header(rows, out.dialect.separator);
  if (at_or_empty(first, 0) != "Format Version") refuse_without_header(rows);
  read_values(first, out);
  const Headings headings = read_headings(rows, out.dialect.separator);
  find_fixed_columns(headings.axis, out);
  out.bodies = bodies_of(headings);
  const auto incomplete = [](const MotiveBody& body) {
    return *std::min_element(body.position.begin(), body.position.end()) < 0;
  };
  out.bodies.erase(std::remove_if(out.bodies.begin(), out.bodies.end(), incomplete), out.bodies.end());
  if (out.bodies.empty())
    throw Error(
        "'" + std::string(rows.file()) + "' holds no rigid body with positions" +
            (headings.type.size() > 3
                 ? ", only columns of type '" +
                       std::string(headings.type.back().empty() ? headings.type[2] : headings.type.back()) +
                       "'"
                 : "") +
            ": solve the assets of the take, and export it again with rigid bodies switched on",
        TrackProblem::no_rigid_body, {std::string(rows.file())});
  return out;
}

}  // namespace astro::truth
