#include "host/truth/files/tum.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "host/base/error.hpp"
#include "host/truth/files/pose_columns.hpp"
#include "host/truth/files/track_problem.hpp"

namespace astro::truth {
namespace {

constexpr double kLengthTolerance = 0.2;  // of a quaternion that was written with few digits, squared

/// A comma wins over blanks, because blanks may follow it.
char tum_separator(std::string_view line) {
  return line.find(',') != line.npos ? ',' : line.find(';') != line.npos ? ';' : ' ';
}

PoseColumns tum_columns(FileKind kind, char separator) {
  PoseColumns columns;
  columns.style = separator;
  columns.rotation = RotationKind::quaternion;
  constexpr Slot kTum[] = {Slot::time, Slot::x, Slot::y, Slot::z, Slot::rx, Slot::ry, Slot::rz, Slot::rw};
  constexpr Slot kEuroc[] = {Slot::time, Slot::x, Slot::y, Slot::z, Slot::rw, Slot::rx, Slot::ry, Slot::rz};
  for (int i = 0; i < 8; ++i) columns[kind == FileKind::euroc ? kEuroc[i] : kTum[i]] = i;
  return columns;
}

bool is_comment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != line.npos && line[first] == '#';
}

}  // namespace

FileKind tum_kind_of(std::string_view line) {
  const char separator = tum_separator(line);
  std::optional<std::string_view> rest = line;
  std::string_view cell, first;
  std::size_t cells = 0;
  double squares = 0;  // of the quaternion, whose order does not matter
  for (; cells < 20 && tables::take_cell(rest, separator, cell); ++cells) {
    if (cells == 0) first = cell;
    const auto value = tables::cell_number(cell, separator);
    if (!value) return FileKind::unknown;
    if (cells >= 4 && cells < 8) squares += *value * *value;
  }
  if (squares != 0 && std::abs(squares - 1) > kLengthTolerance) return FileKind::unknown;
  const bool whole = first.size() >= 15 && std::all_of(first.begin(), first.end(),
                                                       [](unsigned char c) { return std::isdigit(c) != 0; });
  if (whole && cells >= 8 && separator == ',') return FileKind::euroc;
  return cells == 8 ? FileKind::tum : FileKind::unknown;
}

BodyTrack read_tum(std::string_view text, std::string_view file) {
  tables::Rows rows(text, file);
  while (rows.next_filled() && is_comment(rows.text())) {
  }
  BodyTrack track;
  TrackFacts& facts = track.facts;
  facts.kind = is_comment(rows.text()) ? FileKind::unknown : tum_kind_of(rows.text());
  if (facts.kind == FileKind::unknown)
    throw Error("'" + std::string(file) + "' has no row of a time, a position and a quaternion (8 numbers)",
                TrackProblem::no_pose, {std::string(file)});
  facts.format = facts.kind == FileKind::euroc ? "EuRoC" : "TUM";
  facts.length_unit = "m";
  facts.rotation_kind = RotationKind::quaternion;
  facts.rotation = facts.kind == FileKind::euroc ? "quaternion w, x, y, z" : "quaternion x, y, z, w";
  PoseRow row(tum_columns(facts.kind, tum_separator(rows.text())));
  TrackBuilder builder(track, text);
  const int power = facts.kind == FileKind::euroc ? 0 : 9;
  do {
    if (is_comment(rows.text())) continue;
    row.read(rows);
    TrackedPose sample = row.pose();
    const auto time_ns = tables::exact_ns(row.time(), power, ',');
    if (!time_ns)
      rows.refuse(1, tables::shown_cell(row.time()) + " is no time", TrackProblem::no_time,
                  {tables::cut_cell(row.time())});
    sample.time_ns = *time_ns;
    builder.add_stamped(sample, rows);
  } while (rows.next_filled());
  builder.finish(file);
  return track;
}

}  // namespace astro::truth
