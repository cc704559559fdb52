#include "host/truth/files/vicon_header.hpp"

#include <algorithm>
#include <iterator>

#include "host/base/error.hpp"
#include "host/formats/tables/units.hpp"
#include "host/truth/files/track_problem.hpp"

namespace astro::truth {
namespace {

constexpr std::size_t kMostViconBodies = 10'000;

/// "Global Angle (Quaternion) robot:robot" -> "robot:robot"
std::string_view without_prefix(std::string_view name) {
  constexpr std::string_view kPrefix = "Global Angle ";
  if (name.substr(0, kPrefix.size()) != kPrefix) return name;
  name.remove_prefix(kPrefix.size());
  if (const std::size_t close = name.find(") "); !name.empty() && name[0] == '(' && close != name.npos)
    name.remove_prefix(close + 2);
  return name;
}

/// "robot:robot" -> "robot"; the name itself if its halves differ.
std::string subject_of(std::string_view name) {
  const std::size_t colon = name.find(':');
  const bool twice = colon != name.npos && name.substr(0, colon) == name.substr(colon + 1);
  return std::string(twice ? name.substr(0, colon) : name);
}

void set_vicon_column(PoseColumns& columns, std::string_view axis, int at) {
  // The markers of trajectories have X, Y and Z.
  constexpr std::string_view kAxes[] = {"TX", "TY", "TZ", "RX", "RY", "RZ", "RW", "X", "Y", "Z"};
  constexpr Slot kPlaces[] = {Slot::x,  Slot::y,  Slot::z, Slot::rx, Slot::ry,
                              Slot::rz, Slot::rw, Slot::x, Slot::y,  Slot::z};
  const auto* const found = std::find(std::begin(kAxes), std::end(kAxes), axis);
  if (found != std::end(kAxes)) columns[kPlaces[found - std::begin(kAxes)]] = at;
}

void take_units(const tables::Rows& rows, const std::vector<std::string_view>& units, ViconBody& body) {
  const auto unit_at = [&](Slot slot) {
    const int at = body.columns[slot];
    return at >= 0 && static_cast<std::size_t>(at) < units.size() ? units[static_cast<std::size_t>(at)]
                                                                  : std::string_view{};
  };
  PoseColumns& columns = body.columns;
  body.length_unit = unit_at(Slot::x);
  const auto metres = tables::metres_per(body.length_unit);
  if (!metres)
    rows.refuse(columns[Slot::x] + 1, tables::shown_cell(body.length_unit) + " is no unit of length",
                TrackProblem::length_unit_unknown, {tables::cut_cell(body.length_unit)});
  columns.metres = *metres;
  if (columns[Slot::rx] < 0 || columns[Slot::ry] < 0 || columns[Slot::rz] < 0) {
    for (const Slot slot : {Slot::rx, Slot::ry, Slot::rz, Slot::rw}) columns[slot] = -1;
  } else if (columns[Slot::rw] >= 0) {
    columns.rotation = RotationKind::quaternion;
  } else {
    columns.rotation = RotationKind::rotation_vector;
    body.angle_unit = unit_at(Slot::rz);
    const auto radians = tables::radians_per(body.angle_unit);
    if (!radians)
      rows.refuse(columns[Slot::rz] + 1, tables::shown_cell(body.angle_unit) + " is no unit of angle",
                  TrackProblem::angle_unit_unknown, {tables::cut_cell(body.angle_unit)});
    columns.radians = *radians;
  }
}

/// A body whose columns go from `begin` to before `end`.
ViconBody body_at(const std::vector<std::string_view>& axes, std::size_t begin, std::size_t end) {
  ViconBody body;
  body.columns[Slot::frame] = 0;
  body.columns[Slot::time] = axes.size() > 1 && axes[1] == "Sub Frame" ? 1 : -1;
  for (std::size_t i = begin; i < std::min(end, axes.size()); ++i)
    set_vicon_column(body.columns, axes[i], static_cast<int>(i));
  return body;
}

/// Reads the header of a section behind its title, and adds the bodies that have a position.
void read_section_header(tables::Rows& rows, char separator, std::vector<ViconBody>& bodies) {
  const int section_line = rows.line();
  const auto header_row = [&] {
    if (!rows.next()) rows.refuse("the file ends within the header of a section");
    return tables::split_row(rows, separator);
  };
  const auto rate_cells = header_row();
  const auto rate = rate_cells.empty() ? std::nullopt : tables::cell_number(rate_cells[0], separator);
  if (!rate || !(*rate > 0.001 && *rate < 1e6)) rows.refuse("the frame rate in Hz is missing");
  const auto names = header_row();
  const auto axes = header_row();
  if (axes.empty() || axes[0] != "Frame") rows.refuse("the row of axes that begins with Frame is missing");
  const auto units = header_row();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    std::size_t end = i + 1;
    while (end < axes.size() && (end >= names.size() || names[end].empty())) ++end;
    ViconBody body = body_at(axes, i, end);
    const PoseColumns& columns = body.columns;
    if (columns[Slot::x] < 0 || columns[Slot::y] < 0 || columns[Slot::z] < 0) continue;
    if (bodies.size() >= kMostViconBodies) rows.refuse("the file has more than 10000 bodies");
    body.name = {subject_of(without_prefix(names[i])), std::string(without_prefix(names[i]))};
    body.columns.style = separator;
    body.rate_hz = *rate;
    body.section_line = section_line;
    take_units(rows, units, body);
    const auto same = [&](const ViconBody& other) { return other.name == body.name; };
    if (std::none_of(bodies.begin(), bodies.end(), same)) bodies.push_back(std::move(body));
  }
}

}  // namespace

bool is_vicon_title(std::string_view cell) {
  for (const char* title :
       {"Objects", "Segments", "Joints", "Trajectories", "Model Outputs", "Devices", "Events"}) {
    if (cell == title) return true;
  }
  return false;
}

std::vector<ViconBody> find_vicon_bodies(std::string_view text, std::string_view file) {
  tables::Rows rows(text, file);
  std::vector<ViconBody> bodies, markers;  // single markers count only if there is no body
  while (rows.next_filled()) {
    const char separator = rows.text().find(';') != rows.text().npos ? ';' : ',';
    std::optional<std::string_view> rest = rows.text();
    std::string_view title;
    tables::take_cell(rest, separator, title);
    if (!is_vicon_title(title))
      rows.refuse(tables::shown_cell(title) + " is no title of a section of a Vicon export");
    const bool of_bodies = title == "Objects" || title == "Segments" || title == "Joints";
    if (of_bodies || title == "Trajectories") {
      // A file that a spreadsheet saved has its separators in every row but perhaps not in the title.
      tables::Rows ahead = rows;
      for (int i = 0; i < 3; ++i) ahead.next();
      read_section_header(rows, tables::separator_of(ahead.text()), of_bodies ? bodies : markers);
    }
    while (rows.next() && !rows.is_blank()) {
    }
  }
  if (bodies.empty()) bodies = std::move(markers);
  if (bodies.empty())
    throw Error("'" + std::string(file) + "' holds no body in a section Objects, Segments or Trajectories",
                TrackProblem::no_body, {std::string(file)});
  return bodies;
}

}  // namespace astro::truth
