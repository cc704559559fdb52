#include "host/truth/files/plain_csv.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "host/base/csv_table.hpp"
#include "host/truth/files/pose_columns.hpp"
#include "host/truth/files/rotations.hpp"

namespace astro::truth {
namespace {

bool is_unit(std::string_view text) { return metres_per(text) || radians_per(text) || ns_power(text); }

/// A column's name taken apart.
struct ColumnName {
  std::string stem;  // lower case, without the unit: "pose.position.x"
  std::string last;  // behind the last separator: "x"
  std::string unit;  // "" if there is none
};

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
  return out;
}

bool holds(const std::string& text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return text.find(word) != text.npos; });
}

/// What a column holds by its name; nothing if it is of no use here.
std::optional<Slot> slot_named(const ColumnName& name) {
  if (holds(name.stem, {"vel", "twist", "linear", "angular", "acc", "cov", "std", "sigma", "rate", "bias"}))
    return std::nullopt;
  static constexpr std::pair<std::string_view, Slot> kNames[] = {
      {"x", Slot::x},           {"y", Slot::y},           {"z", Slot::z},         {"tx", Slot::x},
      {"ty", Slot::y},          {"tz", Slot::z},          {"px", Slot::x},        {"py", Slot::y},
      {"pz", Slot::z},          {"qx", Slot::rx},         {"qy", Slot::ry},       {"qz", Slot::rz},
      {"qw", Slot::rw},         {"theta", Slot::heading}, {"yaw", Slot::heading}, {"heading", Slot::heading},
      {"psi", Slot::heading},   {"t", Slot::time},        {"time", Slot::time},   {"stamp", Slot::time},
      {"timestamp", Slot::time}};
  const bool turns = holds(name.stem, {"orient", "quat", "rot"});
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
  if (!fits) rows.refuse(column + 1, "the unit " + shown_cell(unit) + " does not fit the column");
  if (!known.empty() && known != unit)
    rows.refuse(column + 1,
                "the positions have different units, " + shown_cell(known) + " and " + shown_cell(unit));
  known = unit;
}

bool has_position(const PoseColumns& columns) {
  return columns[Slot::x] >= 0 && columns[Slot::y] >= 0 && columns[Slot::time] >= 0;
}

PlainHeader plain_header(const Rows& rows) {
  PlainHeader out;
  PoseColumns& columns = out.columns;
  columns.dialect = dialect_of(rows.text());
  const auto cells = split_header(rows, columns.dialect.separator);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const ColumnName name = taken_apart(cells[i]);
    const auto slot = slot_named(name);
    if (!slot || columns[*slot] >= 0) continue;
    columns[*slot] = static_cast<int>(i);
    if (*slot < Slot::rx || *slot > Slot::rw) take_unit(rows, *slot, static_cast<int>(i), name.unit, out);
  }
  const Slot parts[] = {Slot::rx, Slot::ry, Slot::rz, Slot::rw};
  const bool turns = std::all_of(std::begin(parts), std::end(parts), [&](Slot s) { return columns[s] >= 0; });
  for (const Slot slot : parts) columns[slot] = turns ? columns[slot] : -1;
  if (turns) columns[Slot::heading] = -1;
  columns.rotation = turns                         ? RotationKind::quaternion
                     : columns[Slot::heading] >= 0 ? RotationKind::heading
                                                   : RotationKind::none;
  columns.metres = out.length_unit.empty() ? 1 : *metres_per(out.length_unit);
  columns.radians = out.angle_unit.empty() ? 1 : *radians_per(out.angle_unit);
  return out;
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
    facts.remarks.push_back({"the unit of length is not stated: metres are assumed"});
  if (header.columns.rotation == RotationKind::heading && header.angle_unit.empty())
    facts.remarks.push_back({"the unit of the heading is not stated: radians are assumed"});
}

}  // namespace

bool is_plain_header(std::string_view line) {
  Rows rows(line, "");
  if (!rows.next()) return false;
  try {
    return has_position(plain_header(rows).columns);
  } catch (const Error&) {
    return true;  // the reader says what is wrong with it
  }
}

BodyTrack read_plain(std::string_view text, std::string_view file) {
  Rows rows(text, file);
  if (!rows.next_filled()) throw Error("'" + std::string(file) + "' is empty");
  PlainHeader header = plain_header(rows);
  if (!has_position(header.columns))
    rows.refuse("columns for the time and for x and y are needed, such as time_s, x_m and y_m");
  BodyTrack track;
  describe_plain(header, track.facts);
  PoseRow row(header.columns);
  TrackBuilder builder(track, text);
  const bool comma = header.columns.dialect.decimal_comma();
  while (rows.next_filled()) {
    row.read(rows);
    if (header.time_unit.empty()) {
      header.time_unit = assumed_time_unit(row.time(), comma);
      track.facts.remarks.push_back(
          {"the unit of the time is not stated: " + header.time_unit + " is assumed"});
    }
    const auto time_ns = exact_ns(row.time(), *ns_power(header.time_unit), comma);
    if (!time_ns) rows.refuse(header.columns[Slot::time] + 1, shown_cell(row.time()) + " is no time");
    TrackedPose sample = row.pose();
    sample.time_ns = *time_ns;
    builder.add(sample, rows);
  }
  if (builder.repeated_times() > 0)
    track.facts.remarks.push_back({std::to_string(builder.repeated_times()) +
                                   " rows have the time of the row before them and were left out"});
  return track;
}

}  // namespace astro::truth
