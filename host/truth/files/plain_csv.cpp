#include "host/truth/files/plain_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <complex>
#include <iterator>
#include <numbers>
#include <set>
#include <utility>

#include "host/base/error.hpp"
#include "host/formats/tables/stated_columns.hpp"
#include "host/formats/tables/table.hpp"
#include "host/formats/tables/time_column.hpp"
#include "host/formats/tables/units.hpp"
#include "host/truth/files/pose_columns.hpp"
#include "host/truth/files/rotations.hpp"
#include "host/truth/files/track_problem.hpp"

namespace astro::truth {
namespace {

using tables::Table;

constexpr std::size_t kMostBodies = 200;

bool is_unit(std::string_view text) {
  return tables::metres_per(text) || tables::radians_per(text) || tables::ns_power(text);
}

bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

/// In lower case, with an underscore where a capital letter begins a word: "posX" -> "pos_x".
std::string with_underscores(std::string_view name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (i > 0 && is_upper(name[i]) && is_lower(name[i - 1])) out += '_';
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return out;
}

/// A column's name taken apart.
struct ColumnName {
  std::string stem;  // lower case, without the unit: "pose.position.x"
  std::string last;  // behind the last separator: "x"
  std::string body;  // what is before that and before words such as pose and position
  std::string unit;  // "" if there is none
};

/// "/mocap/pose/position/" -> "/mocap"
std::string body_before(std::string stem) {
  static constexpr std::string_view kWords[] = {
      "pose", "position",   "pos",  "translation", "transform", "p",          "q",    "rotation",
      "rot",  "quaternion", "quat", "orientation", "t",         "coordinate", "euler"};
  while (true) {
    while (!stem.empty() && std::string_view("./_ ").find(stem.back()) != std::string_view::npos)
      stem.pop_back();
    const std::string_view word = std::string_view(stem).substr(stem.find_last_of("./_ ") + 1);
    if (std::find(std::begin(kWords), std::end(kWords), word) == std::end(kWords)) return stem;
    stem.resize(stem.size() - word.size());
  }
}

ColumnName taken_apart(std::string_view cell) {
  ColumnName out;
  out.stem = with_underscores(cell.substr(0, 200));
  if (const std::size_t open = out.stem.find_last_of("([");
      open != std::string::npos && open > 0 && (out.stem.back() == ')' || out.stem.back() == ']')) {
    out.unit = out.stem.substr(open + 1, out.stem.size() - open - 2);
    out.stem.resize(open);
    while (!out.stem.empty() && (out.stem.back() == ' ' || out.stem.back() == '_')) out.stem.pop_back();
  } else if (const std::size_t at = out.stem.find_last_of("_ ");
             at != std::string::npos && at > 0 && is_unit(std::string_view(out.stem).substr(at + 1))) {
    out.unit = out.stem.substr(at + 1);
    out.stem.resize(at);
  }
  for (const std::string_view end : {"pos", "position", "coordinate", "coord"})
    if (out.stem.size() > end.size() && out.stem.ends_with(end) &&
        std::string_view("_ .").find(out.stem[out.stem.size() - end.size() - 1]) != std::string_view::npos)
      out.stem.resize(out.stem.size() - end.size() - 1);
  out.last = out.stem.substr(out.stem.find_last_of("./_ ") + 1);
  out.body = body_before(out.stem.substr(0, out.stem.size() - out.last.size()));
  return out;
}

/// Whether one of the words in `text` begins with one of `beginnings`.
bool has_word(const std::string& text, std::initializer_list<std::string_view> beginnings) {
  for (std::size_t at = 0; at < text.size();
       at = text.find_first_of("./_ ", at), at += at != text.npos ? 1 : 0) {
    const std::string_view rest = std::string_view(text).substr(at);
    for (const std::string_view beginning : beginnings) {
      if (rest.substr(0, beginning.size()) == beginning) return true;
    }
  }
  return false;
}

/// What a column holds by its name; nothing if it is of no use here.
std::optional<Slot> slot_named(const ColumnName& name) {
  if (has_word(name.stem,
               {"vel", "twist", "linear", "angular", "acc", "cov", "std", "sigma", "rate", "bias"}))
    return std::nullopt;
  static constexpr std::pair<std::string_view, Slot> kNames[] = {{"x", Slot::x},
                                                                 {"y", Slot::y},
                                                                 {"z", Slot::z},
                                                                 {"tx", Slot::x},
                                                                 {"ty", Slot::y},
                                                                 {"tz", Slot::z},
                                                                 {"px", Slot::x},
                                                                 {"py", Slot::y},
                                                                 {"pz", Slot::z},
                                                                 {"qx", Slot::rx},
                                                                 {"qy", Slot::ry},
                                                                 {"qz", Slot::rz},
                                                                 {"qw", Slot::rw},
                                                                 {"theta", Slot::heading},
                                                                 {"yaw", Slot::heading},
                                                                 {"heading", Slot::heading},
                                                                 {"psi", Slot::heading},
                                                                 {"th", Slot::heading},
                                                                 {"orientation", Slot::heading},
                                                                 {"roll", Slot::roll},
                                                                 {"pitch", Slot::pitch}};
  const bool turns = has_word(name.stem, {"orient", "quat", "rot", "q_", "q."});
  const auto* const found = std::find_if(std::begin(kNames), std::end(kNames),
                                         [&](const auto& entry) { return entry.first == name.last; });
  if (turns && name.last == "w") return Slot::rw;
  if (found == std::end(kNames)) return std::nullopt;
  if (turns && found->second <= Slot::z && found->second >= Slot::x)
    return static_cast<Slot>(static_cast<int>(found->second) + static_cast<int>(Slot::rx) -
                             static_cast<int>(Slot::x));
  return found->second;
}

struct PlainHeader {
  std::string body;
  PoseColumns columns;
  tables::TimeColumns time;
  std::string length_unit, angle_unit;
};

void take_unit(const tables::Rows& rows, Slot slot, int column, const std::string& unit, PlainHeader& out) {
  if (unit.empty()) return;
  const bool angle = slot >= Slot::heading;
  std::string& known = angle ? out.angle_unit : out.length_unit;
  const bool fits = angle ? tables::radians_per(unit).has_value() : tables::metres_per(unit).has_value();
  if (!fits)
    rows.refuse(column + 1, "the unit " + tables::shown_cell(unit) + " does not fit the column",
                TrackProblem::unit_of_other_quantity, {tables::cut_cell(unit)});
  const auto factor = [&](const std::string& one) {
    return angle ? tables::radians_per(one) : tables::metres_per(one);
  };
  if (!known.empty() && factor(known) != factor(unit))
    rows.refuse(column + 1,
                std::string(angle ? "the angles" : "the positions") + " have different units, " +
                    tables::shown_cell(known) + " and " + tables::shown_cell(unit),
                TrackProblem::units_differ, {tables::cut_cell(known), tables::cut_cell(unit)});
  known = unit;
}

/// The columns of the body of this name, which is added if it is new.
PlainHeader& header_of(std::vector<PlainHeader>& headers, const std::string& body) {
  const auto found = std::find_if(headers.begin(), headers.end(), [&](auto& h) { return h.body == body; });
  if (found != headers.end()) return *found;
  headers.emplace_back();
  headers.back().body = body;
  return headers.back();
}

/// Uses the four columns of a quaternion, else the three angles, else a heading, else no rotation.
void settle_columns(PlainHeader& header, const tables::TimeColumns& time, tables::NumberStyle style) {
  PoseColumns& columns = header.columns;
  columns.style = style;
  if (!header.time.at) header.time = time;
  columns[Slot::time] = header.time.at ? static_cast<int>(*header.time.at) : -1;
  constexpr std::array kParts{Slot::rx, Slot::ry, Slot::rz, Slot::rw};
  const auto all = [&](const auto& slots) {
    return std::all_of(slots.begin(), slots.end(), [&](Slot slot) { return columns[slot] >= 0; });
  };
  if (all(kParts)) {
    columns.rotation = RotationKind::quaternion;
  } else if (all(std::array{Slot::roll, Slot::pitch, Slot::heading})) {
    columns.rotation = RotationKind::euler;
    columns.euler_order = "ZYX";
    columns[Slot::rx] = columns[Slot::roll];
    columns[Slot::ry] = columns[Slot::pitch];
    columns[Slot::rz] = columns[Slot::heading];
    columns[Slot::rw] = -1;
  } else {
    columns.rotation = columns[Slot::heading] >= 0 ? RotationKind::heading : RotationKind::none;
    for (const Slot slot : kParts) columns[slot] = -1;
  }
  columns[Slot::roll] = columns[Slot::pitch] = -1;
  if (columns.rotation != RotationKind::heading) columns[Slot::heading] = -1;
  columns.metres = header.length_unit.empty() ? 1 : *tables::metres_per(header.length_unit);
  columns.radians = header.angle_unit.empty() ? 1 : *tables::radians_per(header.angle_unit);
}

bool has_two_rows(Table table) {
  table.rewind();
  return table.next() && table.next() && !table.next();
}

/// The bodies that have a time and a position, each by what its columns' names begin with. A table of two rows needs no time:
/// they are the ends of a drive.
std::vector<PlainHeader> plain_headers(const Table& table, const std::vector<std::string>& names) {
  std::vector<PlainHeader> headers;
  tables::TimeColumns first_time;  // of all bodies that have none of their own
  for (std::size_t i = 0; i < names.size() && headers.size() < kMostBodies; ++i) {
    const ColumnName name = taken_apart(names[i]);
    if (const auto time = tables::time_name(names[i])) {
      if (!first_time.at || first_time.stem == time->stem)
        first_time.take(i, *time);
      else
        header_of(headers, name.body).time.take(i, *time);
      continue;
    }
    const auto slot = slot_named(name);
    if (!slot) continue;
    PlainHeader& header = header_of(headers, name.body);
    if (header.columns[*slot] >= 0) continue;
    header.columns[*slot] = static_cast<int>(i);
    if (*slot < Slot::rx || *slot > Slot::rw)
      take_unit(table.rows(), *slot, static_cast<int>(i), name.unit, header);
  }
  for (PlainHeader& header : headers) settle_columns(header, first_time, table.style());
  const bool ends = !first_time.at && has_two_rows(table);
  std::erase_if(headers, [ends](const PlainHeader& header) {
    const PoseColumns& columns = header.columns;
    return columns[Slot::x] < 0 || columns[Slot::y] < 0 || (columns[Slot::time] < 0 && !ends);
  });
  return headers;
}

/// The column with the number of the tag that a row is about; -1 if there is none.
int tag_column(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = with_underscores(names[i]);
    if (name == "id" || name == "tag" || name == "marker" || name == "tag_id" || name == "marker_id" ||
        name == "body_id")
      return static_cast<int>(i);
  }
  return -1;
}

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

/// How well the direction of motion follows the heading if its unit has so many radians: 1 if they differ by a constant, 0 if
/// they have nothing in common.
class DirectionMatch {
 public:
  explicit DirectionMatch(double radians) : radians_(radians) {}

  void take(double direction_rad, double heading) {
    for (const std::size_t sense : {0U, 1U}) {
      const double apart = direction_rad + (sense == 0 ? -1 : 1) * radians_ * heading;
      forward_[sense] += std::polar(1.0, apart);
      either_way_[sense] += std::polar(1.0, 2 * apart);
    }
    ++count_;
  }
  /// Of a robot that may drive backwards, in a table that may be a mirror image.
  double share() const {
    return std::max(std::abs(either_way_[0]), std::abs(either_way_[1])) / std::max(1, count_);
  }
  /// Of one that drives one way. On a square, driven either way, both senses fit.
  double forward_share(bool clockwise) const {
    return std::abs(forward_[clockwise ? 1 : 0]) / std::max(1, count_);
  }

 private:
  double radians_;
  std::complex<double> forward_[2], either_way_[2];  // by sense: counter-clockwise, clockwise
  int count_ = 0;
};

/// How well the headings of a table match the directions of its motion, by their unit.
struct HeadingMatch {
  DirectionMatch in_radians{1}, in_degrees{*tables::radians_per("deg")};
  double most_angle = 0;

  HeadingMatch(Table& table, const PoseColumns& columns, Slot heading) {
    const double long_enough = kShareOfExtent * extent(table, columns, heading);
    std::optional<std::array<double, 2>> from;
    table.rewind();
    while (table.next()) {
      const auto x = number(table, columns[Slot::x]), y = number(table, columns[Slot::y]),
                 angle = number(table, columns[heading]);
      if (!x || !y || !angle) continue;
      if (from) {
        const double dx = *x - (*from)[0], dy = *y - (*from)[1];
        if (std::hypot(dx, dy) < long_enough || std::hypot(dx, dy) == 0) continue;
        in_radians.take(std::atan2(dy, dx), *angle);
        in_degrees.take(std::atan2(dy, dx), *angle);
      }
      from = {*x, *y};
    }
    table.rewind();
  }

  bool are_degrees() const {
    constexpr double kClear = 0.05;
    if (std::abs(in_degrees.share() - in_radians.share()) > kClear)
      return in_degrees.share() > in_radians.share();
    return most_angle > 2.1 * std::numbers::pi;  // more than a turn, on a straight way
  }

 private:
  static constexpr double kShareOfExtent = 0.02;

  static std::optional<double> number(const Table& table, int column) {
    return tables::cell_number(table.cell(static_cast<std::size_t>(column)), table.style());
  }

  /// The longer side of the area in which the body moves.
  double extent(Table& table, const PoseColumns& columns, Slot heading) {
    std::array<double, 2> least{HUGE_VAL, HUGE_VAL}, most{-HUGE_VAL, -HUGE_VAL};
    table.rewind();
    while (table.next()) {
      for (const std::size_t axis : {0U, 1U}) {
        const auto value = number(table, columns[axis == 0 ? Slot::x : Slot::y]);
        if (value) least[axis] = std::min(least[axis], *value), most[axis] = std::max(most[axis], *value);
      }
      if (const auto angle = number(table, columns[heading]))
        most_angle = std::max(most_angle, std::abs(*angle));
    }
    return std::max(most[0] - least[0], most[1] - least[1]);
  }
};

/// A compass counts clockwise, in axes in which the positions turn the other way.
void settle_sense(const HeadingMatch& match, PlainHeader& header, TrackFacts& facts) {
  constexpr double kClearlyBetter = 0.3;
  const bool degrees = header.columns.radians != 1;
  const DirectionMatch& direction = degrees ? match.in_degrees : match.in_radians;
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
