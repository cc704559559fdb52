#include "host/truth/files/plain_csv.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "host/base/error.hpp"
#include "host/truth/files/pose_columns.hpp"
#include "host/truth/files/rotations.hpp"

namespace astro::truth {
namespace {

bool is_unit(std::string_view text) { return metres_per(text) || radians_per(text) || ns_power(text); }

/// A column's name taken apart.
struct ColumnName {
  std::string stem;  // lower case, without the unit: "pose.position.x"
  std::string last;  // behind the last separator: "x"
  std::string body;  // what is before that and before words such as pose and position
  std::string unit;  // "" if there is none
};

/// "/mocap/pose/position/" -> "/mocap"
std::string body_before(std::string stem) {
  static constexpr std::string_view kWords[] = {"pose",      "position",   "pos",  "translation",
                                                "transform", "p",          "q",    "rotation",
                                                "rot",       "quaternion", "quat", "orientation"};
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
  out.stem = std::string(cell.substr(0, 200));
  for (char& c : out.stem) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
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
  static constexpr std::pair<std::string_view, Slot> kNames[] = {
      {"x", Slot::x},           {"y", Slot::y},           {"z", Slot::z},         {"tx", Slot::x},
      {"ty", Slot::y},          {"tz", Slot::z},          {"px", Slot::x},        {"py", Slot::y},
      {"pz", Slot::z},          {"qx", Slot::rx},         {"qy", Slot::ry},       {"qz", Slot::rz},
      {"qw", Slot::rw},         {"theta", Slot::heading}, {"yaw", Slot::heading}, {"heading", Slot::heading},
      {"psi", Slot::heading},   {"t", Slot::time},        {"time", Slot::time},   {"stamp", Slot::time},
      {"timestamp", Slot::time}};
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
  std::string length_unit, angle_unit, time_unit;
};

void take_unit(const Rows& rows, Slot slot, int column, const std::string& unit, PlainHeader& out) {
  if (unit.empty()) return;
  std::string& known = slot == Slot::time      ? out.time_unit
                       : slot == Slot::heading ? out.angle_unit
                                               : out.length_unit;
  const bool fits = slot == Slot::time      ? ns_power(unit).has_value()
                    : slot == Slot::heading ? radians_per(unit).has_value()
                                            : metres_per(unit).has_value();
  if (!fits)
    rows.refuse(column + 1, "the unit " + shown_cell(unit) + " does not fit the column",
                TrackProblem::unit_of_other_quantity, {cut_cell(unit)});
  if (!known.empty() && known != unit)
    rows.refuse(column + 1,
                "the positions have different units, " + shown_cell(known) + " and " + shown_cell(unit),
                TrackProblem::units_differ, {cut_cell(known), cut_cell(unit)});
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

/// Uses the four columns of a quaternion, else a heading, else no rotation.
void settle_columns(PlainHeader& header, const PlainHeader& time, Dialect dialect) {
  PoseColumns& columns = header.columns;
  columns.dialect = dialect;
  if (columns[Slot::time] < 0) {
    columns[Slot::time] = time.columns[Slot::time];
    header.time_unit = time.time_unit;
  }
  const Slot parts[] = {Slot::rx, Slot::ry, Slot::rz, Slot::rw};
  const bool turns = std::all_of(std::begin(parts), std::end(parts), [&](Slot s) { return columns[s] >= 0; });
  for (const Slot slot : parts) columns[slot] = turns ? columns[slot] : -1;
  if (turns) columns[Slot::heading] = -1;
  columns.rotation = turns                         ? RotationKind::quaternion
                     : columns[Slot::heading] >= 0 ? RotationKind::heading
                                                   : RotationKind::none;
  columns.metres = header.length_unit.empty() ? 1 : *metres_per(header.length_unit);
  columns.radians = header.angle_unit.empty() ? 1 : *radians_per(header.angle_unit);
}

/// The bodies that have a time and a position, each by what its columns' names begin with.
std::vector<PlainHeader> plain_headers(const Rows& rows) {
  constexpr std::size_t kMostBodies = 200;
  const Dialect dialect = dialect_of(rows.text());
  const auto cells = split_header(rows, dialect.separator);
  std::vector<PlainHeader> headers;
  PlainHeader time;  // of all bodies that have none of their own
  for (std::size_t i = 0; i < cells.size() && headers.size() < kMostBodies; ++i) {
    const ColumnName name = taken_apart(cells[i]);
    const auto slot = slot_named(name);
    if (!slot) continue;
    PlainHeader* header = &header_of(headers, name.body);
    if (*slot == Slot::time && time.columns[Slot::time] < 0) header = &time;
    if (header->columns[*slot] >= 0) continue;
    header->columns[*slot] = static_cast<int>(i);
    if (*slot < Slot::rx || *slot > Slot::rw) take_unit(rows, *slot, static_cast<int>(i), name.unit, *header);
  }
  for (PlainHeader& header : headers) settle_columns(header, time, dialect);
  const auto incomplete = [](const PlainHeader& header) {
    const PoseColumns& columns = header.columns;
    return columns[Slot::x] < 0 || columns[Slot::y] < 0 || columns[Slot::time] < 0;
  };
  headers.erase(std::remove_if(headers.begin(), headers.end(), incomplete), headers.end());
  return headers;
}

std::vector<BodyName> names_of(const std::vector<PlainHeader>& headers) {
  std::vector<BodyName> names;
  for (const PlainHeader& header : headers) names.push_back({header.body, ""});
  return names;
}

/// The headers of a table; refused if no body is complete.
std::vector<PlainHeader> required_headers(Rows& rows) {
  if (!rows.next_filled())
    throw Error("'" + std::string(rows.file()) + "' is empty", TrackProblem::empty,
                {std::string(rows.file())});
  std::vector<PlainHeader> headers = plain_headers(rows);
  if (headers.empty())
    rows.refuse("columns for the time and for x and y are needed, such as time_s, x_m and y_m");
  return headers;
}

/// The unit of times without one: the one that makes them an epoch time between 2001 and 2600, else seconds.
const char* assumed_time_unit(std::string_view cell, bool decimal_comma) {
  const double value = cell_number(cell, decimal_comma).value_or(0);
  return value > 1e18 ? "ns" : value > 1e15 ? "us" : value > 1e12 ? "ms" : "s";
}

void describe_plain(const PlainHeader& header, TrackFacts& facts) {
  facts.kind = FileKind::plain;
  facts.format = "CSV";
  facts.length_unit = header.length_unit;
  facts.rotation_kind = header.columns.rotation;
  facts.rotation = header.columns.rotation == RotationKind::quaternion ? "quaternion"
                   : header.columns.rotation == RotationKind::heading  ? "heading about z"
                                                                       : "none";
  if (header.length_unit.empty())
    facts.remarks.push_back(
        {"the unit of length is not stated: metres are assumed", TrackRemark::length_unit_assumed});
  if (header.columns.rotation == RotationKind::heading && header.angle_unit.empty())
    facts.remarks.push_back(
        {"the unit of the heading is not stated: radians are assumed", TrackRemark::heading_unit_assumed});
}

}  // namespace

bool is_plain_header(std::string_view line) {
  Rows rows(line, "");
  if (!rows.next()) return false;
  try {
    return !plain_headers(rows).empty();
  } catch (const Error&) {
    return true;  // the reader says what is wrong with it
  }
}

std::vector<BodyName> bodies_in_plain(std::string_view text, std::string_view file) {
  Rows rows(text, file);
  return names_of(required_headers(rows));
}

BodyTrack read_plain(std::string_view text, std::string_view file, std::string_view body) {
  Rows rows(text, file);
  const std::vector<PlainHeader> headers = required_headers(rows);
  PlainHeader header = headers[choose_body(names_of(headers), body, file)];
  BodyTrack track;
  track.name = header.body;
  describe_plain(header, track.facts);
  PoseRow row(header.columns);
  TrackBuilder builder(track, text);
  const bool comma = header.columns.dialect.decimal_comma();
  while (rows.next_filled()) {
    row.read(rows);
    if (header.time_unit.empty()) {
      header.time_unit = assumed_time_unit(row.time(), comma);
      track.facts.remarks.push_back(
          {"the unit of the time is not stated: " + header.time_unit + " is assumed",
           TrackRemark::time_unit_assumed,
           {header.time_unit}});
    }
    const auto time_ns = exact_ns(row.time(), *ns_power(header.time_unit), comma);
    if (!time_ns)
      rows.refuse(header.columns[Slot::time] + 1, shown_cell(row.time()) + " is no time",
                  TrackProblem::no_time, {cut_cell(row.time())});
    TrackedPose sample = row.pose();
    sample.time_ns = *time_ns;
    builder.add(sample, rows);
  }
  if (builder.repeated_times() > 0) track.facts.remarks.push_back(repeated_times(builder));
  return track;
}

}  // namespace astro::truth
