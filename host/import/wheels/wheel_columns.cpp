#include "host/import/wheels/wheel_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/base/side.hpp"
#include "host/formats/tables/column_name.hpp"
#include "host/import/wheels/joint_names.hpp"
#include "host/import/wheels/travel_measure.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::importing {
namespace {

using tables::ColumnName;
using tables::Quantity;

/// The side that a name shows; nothing if it shows none, or both.
std::optional<Side> side_of(const ColumnName& name) {
  std::optional<Side> side;
  for (const auto& one : sided_words(name.words)) {
    if (one && side && one->side != side) return std::nullopt;
    if (one) side = one->side;
  }
  return side;
}

/// What a column holds, by its name.
struct Wheel {
  std::size_t column = 0;
  Side side = Side::left;
  Quantity quantity = Quantity::counts;
  double to_si = 1;
  std::string unit_text;  // as in the name
  bool per_interval = false;
  bool perhaps_per_interval = false;  // "d_left" may be a difference, or a distance
  bool sure = true;                   // its unit is stated, or its name leaves no other

  bool same_kind(const Wheel& other) const {
    return quantity == other.quantity && to_si == other.to_si && per_interval == other.per_interval &&
           perhaps_per_interval == other.perhaps_per_interval;
  }
};

/// A unit may stand in front of the side, too: "rpm_left", "rad_s_left". One letter there is no unit.
void take_unit_in_front(ColumnName& name) {
  if (name.unit || !name.unit_text.empty() || name.words.size() < 2) return;
  for (std::size_t count = std::min<std::size_t>(2, name.words.size() - 1); count > 0; --count) {
    const std::string text = count == 2 ? name.words[0] + '_' + name.words[1] : name.words[0];
    const auto unit = tables::unit_named(text);
    if (!unit || text.size() == 1 || text == "in") continue;
    name.unit = unit;
    name.unit_text = text;
    name.words.erase(name.words.begin(), name.words.begin() + static_cast<std::ptrdiff_t>(count));
    return;
  }
}

std::optional<Wheel> wheel_named(ColumnName name, std::size_t column) {
  take_unit_in_front(name);
  const auto side = side_of(name);
  if (!side || is_of_no_use(name.words)) return std::nullopt;
  Wheel wheel;
  wheel.column = column;
  wheel.side = *side;
  wheel.per_interval = name.has({"delta", "diff", "increment", "interval"});
  wheel.perhaps_per_interval = name.has({"d", "dl", "dr"});
  if (name.unit) {
    wheel.quantity = name.unit->quantity;
    wheel.to_si = name.unit->to_si;
    wheel.unit_text = name.unit_text;
    return wheel;
  }
  if (!name.unit_text.empty()) return std::nullopt;  // volts, amperes, or what nobody knows
  const bool counts = std::any_of(name.words.begin(), name.words.end(), [](const std::string& word) {
    for (const std::string_view counter : {"enc", "tick", "count", "pulse"})
      if (word.starts_with(counter)) return true;
    return false;
  });
  wheel.sure = counts;
  if (name.has({"vel", "velocity", "speed", "omega", "w", "v"}) && !counts)
    wheel.quantity = Quantity::angular_speed;
  return wheel;
}

/// Columns of one kind, with as many on the left as on the right.
struct Group {
  std::vector<Wheel> wheels;

  std::vector<std::size_t> of(Side side) const {
    std::vector<std::size_t> columns;
    for (const Wheel& wheel : wheels)
      if (wheel.side == side) columns.push_back(wheel.column);
    return columns;
  }
  bool is_complete() const {
    return !of(Side::left).empty() && of(Side::left).size() == of(Side::right).size();
  }
};

std::vector<Group> groups_of(const std::vector<Wheel>& wheels) {
  std::vector<Group> groups;
  for (const Wheel& wheel : wheels) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& one) {
      return one.wheels.front().same_kind(wheel) && one.wheels.front().sure == wheel.sure;
    });
    if (group == groups.end())
      groups.push_back({{wheel}});
    else
      group->wheels.push_back(wheel);
  }
  return groups;
}

/// Travel as counts is better than as angles, because it is exact, and any travel is better than a speed.
int rank_of(const Wheel& wheel) {
  constexpr std::array kOrder{Quantity::counts,       Quantity::angle,         Quantity::length,
                              Quantity::counts_speed, Quantity::angular_speed, Quantity::speed};
  const auto at = std::find(kOrder.begin(), kOrder.end(), wheel.quantity) - kOrder.begin();
  return 2 * static_cast<int>(at) + (wheel.sure ? 0 : 20) +
         (wheel.per_interval || wheel.perhaps_per_interval ? 1 : 0);
}

bool are_whole_numbers(tables::Table& table, const std::vector<std::size_t>& columns) {
  constexpr std::size_t kRowsLookedAt = 2000;
  table.rewind();
  bool whole = true, any = false;
  for (std::size_t row = 0; whole && row < kRowsLookedAt && table.next(); ++row)
    for (const std::size_t column : columns) {
      const auto value = tables::cell_number(table.cell(column), table.style());
      if (!value) continue;
      any = true;
      const char decimal = table.style().decimal;
      const std::string fractions = std::string("eE") + (decimal == '\0' ? ".," : std::string(1, decimal));
      whole = whole && *value == std::floor(*value) &&
              table.cell(column).find_first_of(fractions) == std::string_view::npos;
    }
  table.rewind();
  return whole && any;
}

/// Whether these columns end at the value with which they began, as travel per row of a robot that stands at both ends does, and
/// go up and down by turns, as the differences of a counter do. A distance that counts on and comes back to where it began
/// turns only where the robot does.
bool are_travel_per_row(tables::Table& table, const std::vector<std::size_t>& columns) {
  constexpr double kSame = 0.1;   // of the range: a robot may begin to move in the first row
  constexpr double kTurns = 0.1;  // of the steps: 0.7 where counts are rounded, below 0.01 of distances
  bool all = true;
  for (const std::size_t column : columns) {
    std::optional<double> first, last;
    double least = HUGE_VAL, most = -HUGE_VAL, step = 0, steps = 0, turns = 0;
    table.rewind();
    while (table.next()) {
      const auto value = tables::cell_number(table.cell(column), table.style());
      if (!value) continue;
      if (!first) first = value;
      if (last && *value != *last) {
        turns += step * (*value - *last) < 0 ? 1 : 0;
        step = *value > *last ? 1 : -1;
        ++steps;
      }
      last = value;
      least = std::min(least, *value);
      most = std::max(most, *value);
    }
    all = all && first && std::abs(*last - *first) <= kSame * (most - least) && turns >= kTurns * steps;
  }
  table.rewind();
  return all;
}

[[noreturn]] void refuse(const tables::Table& table, const std::vector<std::string>& names,
                         const std::string& why) {
  // Of columns of which only some were stated the others have no names here.
  const bool partly = std::ranges::count(names, "") > 0 && !table.names().empty();
  std::vector<std::string> shown;
  for (const std::string& name : partly ? table.names() : names)
    if (shown.size() < 40) shown.push_back(tables::cut_cell(name));
  throw UnclearChoice(fmt::format("{}: {}; the columns are {}", table.rows().file(), why, listed(shown)),
                      shown, WheelProblem::columns_unclear);
}

}  // namespace

WheelColumns wheel_columns(const std::vector<std::string>& names, tables::Table& table) {
  if (names.empty()) {
    table.next();
    refuse(table, {table.cells().begin(), table.cells().end()},
           fmt::format("there are no names above its {} columns", table.columns()));
  }
  WheelColumns out;
  std::vector<Wheel> wheels;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const auto time = tables::time_name(names[i])) {
      out.time.take(i, *time);
      continue;
    }
    if (const auto wheel = wheel_named(tables::column_name(names[i]), i)) wheels.push_back(*wheel);
  }
  if (!out.time.at) refuse(table, names, "no column is named as a time");
  std::vector<Group> groups = groups_of(wheels);
  std::erase_if(groups, [](const Group& group) { return !group.is_complete(); });
  if (groups.empty()) {
    const auto has = [&](Side side) {
      return std::any_of(wheels.begin(), wheels.end(), [&](const Wheel& one) { return one.side == side; });
    };
    refuse(table, names,
           has(Side::left) == has(Side::right)
               ? has(Side::left) ? "the columns of the left and the right wheel are of different kinds"
                                 : "no columns are named as the left and the right wheel"
               : fmt::format("no column is named as the {} wheel", has(Side::left) ? "right" : "left"));
  }
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return rank_of(a.wheels.front()) < rank_of(b.wheels.front());
  });
  const Group& chosen = groups.front();
  const Wheel& kind = chosen.wheels.front();
  out.left = chosen.of(Side::left);
  out.right = chosen.of(Side::right);
  if (out.left.size() > 3)
    refuse(table, names, fmt::format("{} columns are named as a left wheel", out.left.size()));
  out.speeds = !is_travel(kind.quantity);
  std::vector<std::size_t> columns = out.left;
  columns.insert(columns.end(), out.right.begin(), out.right.end());
  out.per_interval =
      !out.speeds && (kind.per_interval || (kind.perhaps_per_interval && are_travel_per_row(table, columns)));
  if (out.per_interval && !kind.per_interval)
    out.remarks.push_back({fmt::format("{} ends as it begins and goes up and down by turns: it is taken as "
                                       "the travel since the row before",
                                       tables::shown_cell(names[out.left.front()])),
                           WheelRemark::per_interval_assumed,
                           {names[out.left.front()]}});
  out.unit = wheel_unit(kind.quantity);
  out.scale = kind.to_si;
  out.unit_text = kind.unit_text;
  if (!kind.sure) {
    if (out.speeds)
      refuse(table, names,
             tables::shown_cell(names[out.left.front()]) +
                 " does not say its unit: rad/s, rpm and m/s are possible");
    if (!are_whole_numbers(table, columns))
      refuse(table, names,
             tables::shown_cell(names[out.left.front()]) +
                 " does not say its unit: counts, rad and m are possible");
    out.remarks.push_back({fmt::format("{} holds whole numbers, which are taken as counts",
                                       tables::shown_cell(names[out.left.front()])),
                           WheelRemark::counts_assumed,
                           {names[out.left.front()]}});
  }
  return out;
}

}  // namespace astro::importing
