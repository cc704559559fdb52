#include "host/truth/files/plain_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "host/base/error.hpp"
#include "host/formats/tables/stated_columns.hpp"
#include "host/formats/tables/table.hpp"
#include "host/formats/tables/time_column.hpp"
#include "host/formats/tables/units.hpp"
#include "host/truth/files/heading_match.hpp"
#include "host/truth/files/plain_columns.hpp"
#include "host/truth/files/pose_columns.hpp"
#include "host/truth/files/track_problem.hpp"

namespace astro::truth {
namespace {

using tables::Table;

/// What is written in the column of tags, if several tags are; empty otherwise.
std::vector<BodyName> tags_in(Table& table, int column) {
  if (column < 0) return {};
  std::vector<BodyName> tags;
  std::set<std::string, std::less<>> known;
  while (known.size() < kMostBodies && table.next()) {
    const std::string_view tag = table.cell(static_cast<std::size_t>(column));
    if (tag.empty() || known.contains(tag)) continue;
    known.emplace(tag);
    tags.push_back({std::string(tag), ""});
  }
  table.rewind();
  if (tags.size() < 2) tags.clear();
  return tags;
}

/// A table with the names of its columns, and the bodies that they are about.
struct PlainBodies {
  explicit PlainBodies(const PlainTable& plain)
      : table(plain.text, plain.file), stated(!plain.columns.empty()) {
    const std::vector<std::string> names = tables::names_with(plain.columns, table);
    headers = plain_headers(table, names);
    if (headers.size() == 1) {
      tag = tag_column(names);
      tags = tags_in(table, tag);
    }
  }

  /// Throws astro::Error if there is no body.
  std::vector<BodyName> names() const {
    if (headers.empty()) refuse();
    table.require_names();
    if (!tags.empty()) return tags;
    std::vector<BodyName> all;
    for (const PlainHeader& header : headers) all.push_back({header.body, ""});
    return all;
  }

  [[noreturn]] void refuse() const {
    const std::string file(table.rows().file());
    if (table.names().empty() && !stated)
      throw Error(
          "'" + file +
              "' begins with numbers: without a header its columns have no meaning: export the recording "
              "again with its header",
          TrackProblem::no_header, {file});
    std::vector<std::string> values{file};
    std::string listed;
    for (const std::string& name : table.names()) {
      values.push_back(tables::cut_cell(name));
      listed += (listed.empty() ? "" : ", ") + values.back();
    }
    throw Error("'" + file + "' has no columns for the time and for x and y, such as time_s, x_m and y_m" +
                    (listed.empty() ? "" : "; its columns are " + listed),
                TrackProblem::no_columns, std::move(values));
  }

  Table table;
  std::vector<PlainHeader> headers;
  std::vector<BodyName> tags;
  int tag = -1;
  bool stated;
};

void describe_plain(const PlainHeader& header, TrackFacts& facts) {
  facts.kind = FileKind::plain;
  facts.format = "CSV";
  facts.length_unit = header.length_unit;
  facts.flat = header.columns[Slot::z] < 0;
  facts.rotation_kind = header.columns.rotation;
  facts.rotation = header.columns.rotation == RotationKind::quaternion ? "quaternion"
                   : header.columns.rotation == RotationKind::euler    ? "roll, pitch and yaw"
                   : header.columns.rotation == RotationKind::heading  ? "heading about z"
                                                                       : "none";
  if (header.length_unit.empty())
    facts.remarks.push_back(
        {"the unit of length is not stated: metres are assumed", TrackRemark::length_unit_assumed});
}

/// A compass counts clockwise, in axes in which the positions turn the other way.
void settle_sense(const HeadingMatch& match, PlainHeader& header, TrackFacts& facts) {
  constexpr double kClearlyBetter = 0.3;
  const bool degrees = header.columns.radians != 1;
  const DirectionMatch& direction = match.in(degrees);
  if (header.columns.rotation != RotationKind::heading ||
      direction.forward_share(true) < direction.forward_share(false) + kClearlyBetter)
    return;
  header.columns.radians = -header.columns.radians;
  facts.remarks.push_back(
      {"the headings count clockwise, as the directions of motion show; they were turned round",
       TrackRemark::headings_clockwise});
}

void settle_angles(Table& table, PlainHeader& header, TrackFacts& facts) {
  PoseColumns& columns = header.columns;
  if (columns.rotation != RotationKind::heading && columns.rotation != RotationKind::euler) return;
  const HeadingMatch match(table, columns,
                           columns.rotation == RotationKind::heading ? Slot::heading : Slot::rz);
  if (header.angle_unit.empty()) {
    columns.radians = match.are_degrees() ? *tables::radians_per("deg") : 1;
    const std::string unit = columns.radians != 1 ? "degrees" : "radians";
    facts.remarks.push_back({"the unit of the heading is not stated: " + unit + " are assumed",
                             TrackRemark::heading_unit_assumed,
                             {unit}});
  }
  settle_sense(match, header, facts);
}

[[noreturn]] void refuse_time(const Table& table, const PlainHeader& header, std::string_view cell) {
  table.rows().refuse(header.columns[Slot::time] + 1,
                      tables::shown_cell(cell) + " is no time, which is " + std::string(tables::kTimesRead),
                      TrackProblem::no_time, {tables::cut_cell(cell)});
}

/// Throws astro::Error if the table does not show in which unit its times are.
tables::TimeFormat settle_times(Table& table, PlainHeader& header, TrackFacts& facts) {
  header.time.settle(table);
  header.columns[Slot::time] = static_cast<int>(*header.time.at);
  header.columns[Slot::time_fraction] = header.time.fraction ? static_cast<int>(*header.time.fraction) : -1;
  const auto format = tables::time_format(table, header.time);
  if (!format) {
    if (table.next() && !tables::cell_number(table.cell(*header.time.at), table.style()))
      refuse_time(table, header, table.cell(*header.time.at));
    if (!table.cells().empty())
      table.rows().refuse(header.columns[Slot::time] + 1,
                          "the column does not show the unit of its times: s, ms, us and ns are possible",
                          TrackProblem::time_unit_unknown);
    return {};
  }
  if (!header.time.power && format->kind == tables::TimeKind::number) {
    const std::string unit(tables::unit_text(format->power));
    facts.remarks.push_back({"the unit of the time is not stated: " + unit + " is assumed",
                             TrackRemark::time_unit_assumed,
                             {unit}});
  }
  return *format;
}

}  // namespace

bool is_plain(std::string_view text) {
  try {
    const Table table(text, "");
    return !plain_headers(table, table.names()).empty();
  } catch (const Error&) {
    return false;
  }
}

std::vector<BodyName> bodies_in_plain(const PlainTable& table) { return PlainBodies(table).names(); }

BodyTrack read_plain(const PlainTable& plain, std::string_view body) {
  PlainBodies bodies(plain);
  const std::vector<BodyName> names = bodies.names();
  const std::size_t chosen = choose_body(names, body, plain.file);
  PlainHeader& header = bodies.headers[bodies.tags.empty() ? chosen : 0];
  Table& table = bodies.table;
  BodyTrack track;
  track.name = names[chosen].name;
  describe_plain(header, track.facts);
  settle_angles(table, header, track.facts);
  const bool timed = header.columns[Slot::time] >= 0;
  const tables::TimeFormat format = timed ? settle_times(table, header, track.facts) : tables::TimeFormat{};
  if (!timed)
    track.facts.remarks.push_back(
        {"there are no times: the two rows are taken for the poses before and after a drive",
         TrackRemark::ends_without_times});
  tables::TimeReader times(header.time, format, table.style());
  PoseRow row(header.columns);
  TrackBuilder builder(track, plain.text);
  while (table.next()) {
    if (!bodies.tags.empty() && table.cell(static_cast<std::size_t>(bodies.tag)) != track.name) continue;
    row.read(table.rows());
    const auto row_ns = static_cast<std::int64_t>(track.samples.size()) * 1'000'000'000;
    const auto time_ns = timed ? times.read(row.time(), row.time_fraction()) : row_ns;
    if (!time_ns) refuse_time(table, header, row.time());
    TrackedPose sample = row.pose();
    sample.time_ns = *time_ns;
    builder.add_stamped(sample, table.rows());
  }
  if (const auto range_s = times.started_again_s())
    track.facts.remarks.push_back(
        {fmt::format("the times start again after {:.6g} s; they were made continuous", *range_s),
         TrackRemark::times_continued,
         {fmt::format("{:.6g}", *range_s)}});
  builder.finish(plain.file);
  return track;
}

}  // namespace astro::truth
