#include "host/truth/files/qualisys_tsv.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "host/base/error.hpp"
#include "host/formats/tables/rows.hpp"
#include "host/truth/files/frame_numbers.hpp"
#include "host/truth/files/pose_columns.hpp"
#include "host/truth/files/rotations.hpp"
#include "host/truth/files/track_problem.hpp"

namespace astro::truth {
namespace {

using Cells = std::vector<std::string_view>;

constexpr double kMillimetre = 1e-3;
// A body has X, Y, Z, roll, pitch, yaw, a residual and the nine cells of a matrix; a marker has X, Y and Z.
constexpr std::size_t kCellsOfBody = 16, kCellsOfMarker = 3;

struct QualisysHeader {
  double rate_hz = 0;
  bool bodies = false;
  std::vector<std::string> names;
  std::string start_time;
};

/// "2020-12-23, 01:18:10.123" and "2020-12-23 01:18:10.123" with a T between them.
std::string with_t(std::string_view stamp) {
  std::string out(stamp.substr(0, 24));
  for (const std::string_view between : {", ", " "})
    if (const std::size_t at = out.find(between); at != std::string::npos)
      return out.replace(at, between.size(), "T");
  return out;
}

/// Takes the lines of the header; `rows` is then at the first line after it.
QualisysHeader take_header(tables::Rows& rows) {
  QualisysHeader header;
  while (rows.next_filled()) {
    const Cells cells = tables::split_row(rows, '\t');
    const std::string_view key = cells.front(), value = cells.size() > 1 ? cells[1] : std::string_view();
    if (key == "FREQUENCY") header.rate_hz = tables::cell_number(value, '\t').value_or(0);
    if (key == "DATA_INCLUDED") header.bodies = value == "6D";
    if (key == "TIME_STAMP") header.start_time = with_t(value);
    if (key == "BODY_NAMES" || key == "MARKER_NAMES") {
      header.bodies = key == "BODY_NAMES";
      for (const std::string_view name : std::span(cells).subspan(1))
        if (!name.empty()) header.names.emplace_back(name);
    }
    const bool is_key = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
      return (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
    }) && !tables::cell_number(key, '\t');
    if (!is_key || key == "X") break;
  }
  const std::string file(rows.file());
  if (!(header.rate_hz > 0.001 && header.rate_hz < 1e6) || header.names.empty())
    throw Error("'" + file +
                    "' is an export of Qualisys without its frequency or the names of its bodies: export it "
                    "again with its header",
                TrackProblem::no_header, {file});
  return header;
}

/// Where the cells of a body are in a row, and how far they reach.
struct Place {
  std::size_t first = 0, frame_cells = 0;
};

Place place_of(const QualisysHeader& header, std::size_t body, std::size_t cells, const tables::Rows& rows) {
  const std::size_t each = header.bodies ? kCellsOfBody : kCellsOfMarker,
                    of_bodies = each * header.names.size();
  if (cells < of_bodies || cells > of_bodies + 2)
    rows.refuse("the row has " + std::to_string(cells) + " cells, and " +
                    std::to_string(header.names.size()) +
                    (header.bodies ? " bodies have " : " markers have ") + std::to_string(of_bodies),
                TrackProblem::columns_differ, {std::to_string(cells), std::to_string(of_bodies)});
  return {cells - of_bodies + each * body, cells - of_bodies};
}

/// An empty cell is no error: the body was lost.
std::optional<double> number(const Cells& cells, std::size_t at, const tables::Rows& rows) {
  if (cells[at].empty() || cells[at] == "NaN" || cells[at] == "nan") return std::nullopt;
  const auto value = tables::cell_number(cells[at], '\t');
  if (!value)
    rows.refuse(static_cast<int>(at) + 1, tables::shown_cell(cells[at]) + " is not a number",
                TrackProblem::not_a_number, {tables::cut_cell(cells[at])});
  return value;
}

TrackedPose pose_at(const Cells& cells, std::size_t first, bool is_body, const tables::Rows& rows) {
  TrackedPose sample;
  std::array<double, kCellsOfBody> values{};
  for (std::size_t i = 0; i < (is_body ? kCellsOfBody : kCellsOfMarker); ++i) {
    const auto value = number(cells, first + i, rows);
    sample.valid = sample.valid && value.has_value();
    values[i] = value.value_or(0);
  }
  sample.valid =
      sample.valid && (values[0] != 0 || values[1] != 0 || values[2] != 0) && !(is_body && values[6] < 0);
  if (!sample.valid) return sample;
  sample.pose = {kMillimetre * values[0], kMillimetre * values[1], kMillimetre * values[2]};
  if (is_body) {
    Eigen::Matrix3d matrix;
    for (int i = 0; i < 9; ++i) matrix(i % 3, i / 3) = values[7 + static_cast<std::size_t>(i)];
    const Eigen::Quaterniond q(matrix);
    set_rotation(sample.pose, {q.x(), q.y(), q.z(), q.w()});
    sample.valid = is_possible(sample.pose);
    if (sample.valid) normalise(sample.pose);
  }
  return sample;
}

std::vector<BodyName> names_of(const QualisysHeader& header) {
  std::vector<BodyName> names;
  for (const std::string& name : header.names) names.push_back({name, ""});
  return names;
}

bool is_row_of_numbers(const Cells& cells) { return tables::cell_number(cells.front(), '\t').has_value(); }

}  // namespace

bool is_qualisys(std::string_view text) {
  tables::Rows rows(text, "");
  return rows.next_filled() && tables::split_row(rows, '\t').front() == "NO_OF_FRAMES";
}

std::vector<BodyName> bodies_in_qualisys(std::string_view text, std::string_view file) {
  tables::Rows rows(text, file);
  return names_of(take_header(rows));
}

BodyTrack read_qualisys(std::string_view text, std::string_view file, std::string_view body) {
  tables::Rows rows(text, file);
  const QualisysHeader header = take_header(rows);
  const std::size_t chosen = choose_body(names_of(header), body, file);
  BodyTrack track;
  track.name = header.names[chosen];
  track.facts.kind = FileKind::qualisys;
  track.facts.format = header.bodies ? "Qualisys TSV 6D" : "Qualisys TSV 3D";
  track.facts.rate_hz = header.rate_hz;
  track.facts.length_unit = "mm";
  track.facts.start_time = header.start_time;
  track.facts.rotation_kind = header.bodies ? RotationKind::quaternion : RotationKind::none;
  track.facts.rotation = header.bodies ? "rotation matrix" : "none";
  FrameNumbers frames('\t');
  TrackBuilder builder(track, text);
  std::int64_t row = 0;
  do {
    if (rows.text().empty()) continue;
    const Cells cells = tables::split_row(rows, '\t');
    if (row == 0 && !is_row_of_numbers(cells)) continue;  // the names of the columns
    const Place place = place_of(header, chosen, cells.size(), rows);
    // A single cell before the numbers is a time, and these are rounded.
    const std::int64_t frame = place.frame_cells == 2 ? frames.take(cells.front(), rows) : row;
    ++row;
    TrackedPose sample = pose_at(cells, place.first, header.bodies, rows);
    sample.time_ns = frame_time_ns(frame, header.rate_hz, rows);
    builder.add(sample, rows);
  } while (rows.next());  // a row of nothing but tabs is a frame in which all bodies were lost
  track.facts.dropped_frames = frames.dropped();
  builder.finish(file);
  return track;
}

}  // namespace astro::truth
