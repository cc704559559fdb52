#include "host/truth/files/plain_columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "host/base/text/trimmed.hpp"
#include "host/formats/tables/column_name.hpp"
#include "host/formats/tables/units.hpp"
#include "host/truth/files/track_problem.hpp"

namespace astro::truth {
namespace {

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
struct PoseColumnName {
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

/// The unit that a name states, of a length or an angle if it is not in brackets.
std::string unit_in(std::string_view cell) {
  const tables::ColumnName name = tables::column_name(cell);
  const bool in_brackets = cell.ends_with(')') || cell.ends_with(']');
  return in_brackets || tables::metres_per(name.unit_text) || tables::radians_per(name.unit_text)
             ? name.unit_text
             : "";
}

PoseColumnName taken_apart(std::string_view cell) {
  PoseColumnName out;
  cell = trimmed(cell.substr(0, 200));
  out.unit = unit_in(cell);
  out.stem = with_underscores(cell);
  if (cell.ends_with(')') || cell.ends_with(']'))
    out.stem.resize(std::min(out.stem.size(), out.stem.find_last_of("([")));
  else if (const std::size_t at = out.stem.find_last_of("_ ./-:");
           !out.unit.empty() && at != std::string::npos)
    out.stem.resize(at);
  while (!out.stem.empty() && (out.stem.back() == ' ' || out.stem.back() == '_')) out.stem.pop_back();
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
std::optional<Slot> slot_named(const PoseColumnName& name) {
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

bool has_two_rows(tables::Table table) {
  table.rewind();
  return table.next() && table.next() && !table.next();
}

}  // namespace

std::vector<PlainHeader> plain_headers(const tables::Table& table, const std::vector<std::string>& names) {
  std::vector<PlainHeader> headers;
  tables::TimeColumns first_time;  // of all bodies that have none of their own
  for (std::size_t i = 0; i < names.size() && headers.size() < kMostBodies; ++i) {
    const PoseColumnName name = taken_apart(names[i]);
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

int tag_column(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = with_underscores(names[i]);
    if (name == "id" || name == "tag" || name == "marker" || name == "tag_id" || name == "marker_id" ||
        name == "body_id")
      return static_cast<int>(i);
  }
  return -1;
}

}  // namespace astro::truth
