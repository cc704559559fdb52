#include "host/truth/files/motive_header.hpp"

#include <algorithm>
#include <cctype>

#include "host/base/error.hpp"
#include "host/truth/files/track_problem.hpp"

namespace astro::truth {
namespace {

using HeaderCells = std::vector<std::string_view>;

constexpr std::size_t kMostHeadingRows = 16;

std::string_view at_or_empty(const HeaderCells& cells, std::size_t index) {
  return index < cells.size() ? cells[index] : std::string_view{};
}

[[noreturn]] void refuse_without_header(const tables::Rows& rows) {
  throw Error(
      "'" + std::string(rows.file()) +
          "' has no header of Motive with a row that begins with Frame, so its columns have no meaning: "
          "export the recording again with its header",
      TrackProblem::no_motive_header, {std::string(rows.file())});
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

Headings read_headings(tables::Rows& rows, char separator) {
  std::vector<HeaderCells> above;
  Headings out;
  while (rows.next_filled() && above.size() <= kMostHeadingRows) {
    HeaderCells cells = tables::split_row(rows, separator);
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
  const std::size_t index = axis.size() == 1 ? std::string_view("XYZW").find(static_cast<char>(
                                                   std::toupper(static_cast<unsigned char>(axis[0]))))
                                             : std::string_view::npos;
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

[[noreturn]] void refuse_without_bodies(const tables::Rows& rows, const Headings& headings) {
  const std::string file(rows.file());
  const bool bones = std::any_of(headings.type.begin(), headings.type.end(),
                                 [](std::string_view type) { return type.starts_with("Bone"); });
  if (bones)
    throw Error(
        "'" + file +
            "' holds the bones of a skeleton and no rigid body: make a rigid body of the robot's markers, "
            "and export the take again with rigid bodies switched on",
        TrackProblem::no_rigid_body, {file});
  const std::string_view type = headings.type.size() <= 3      ? std::string_view()
                                : headings.type.back().empty() ? headings.type[2]
                                                               : headings.type.back();
  throw Error("'" + file + "' holds no rigid body with positions" +
                  (type.empty() ? "" : ", only columns of type '" + std::string(type) + "'") +
                  ": solve the assets of the take, and export it again with rigid bodies switched on",
              TrackProblem::no_rigid_body, {file});
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
  const auto number = tables::cell_number(value(key), separator);
  return number && *number > 0 ? *number : 0;
}

MotiveHeader read_motive_header(tables::Rows& rows) {
  if (!rows.next_filled())
    throw Error("'" + std::string(rows.file()) + "' is empty", tables::TextProblem::empty,
                {std::string(rows.file())});
  MotiveHeader out;
  out.separator = tables::separator_of(rows.text());
  const HeaderCells first = tables::split_row(rows, out.separator);
  if (at_or_empty(first, 0) != "Format Version") refuse_without_header(rows);
  read_values(first, out);
  const Headings headings = read_headings(rows, out.separator);
  find_fixed_columns(headings.axis, out);
  out.bodies = bodies_of(headings);
  const auto incomplete = [](const MotiveBody& body) {
    return *std::min_element(body.position.begin(), body.position.end()) < 0;
  };
  out.bodies.erase(std::remove_if(out.bodies.begin(), out.bodies.end(), incomplete), out.bodies.end());
  if (out.bodies.empty()) refuse_without_bodies(rows, headings);
  return out;
}

}  // namespace astro::truth
