#include "host/truth/files/heading_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "host/base/text/degrees.hpp"

namespace astro::truth {
namespace {

constexpr double kShareOfExtent = 0.02;

std::optional<double> number(const tables::Table& table, int column) {
  return tables::cell_number(table.cell(static_cast<std::size_t>(column)), table.style());
}

}  // namespace

void DirectionMatch::take(double direction_rad, double heading) {
  for (const std::size_t sense : {0U, 1U}) {
    const double apart = direction_rad + (sense == 0 ? -1 : 1) * radians_ * heading;
    forward_[sense] += std::polar(1.0, apart);
    either_way_[sense] += std::polar(1.0, 2 * apart);
  }
  ++count_;
}

double DirectionMatch::share() const {
  return std::max(std::abs(either_way_[0]), std::abs(either_way_[1])) / std::max(1, count_);
}

double DirectionMatch::forward_share(bool clockwise) const {
  return std::abs(forward_[clockwise ? 1 : 0]) / std::max(1, count_);
}

HeadingMatch::HeadingMatch(tables::Table& table, const PoseColumns& columns, Slot heading)
    : in_radians_(1), in_degrees_(radians(1)) {
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
      in_radians_.take(std::atan2(dy, dx), *angle);
      in_degrees_.take(std::atan2(dy, dx), *angle);
    }
    from = {*x, *y};
  }
  table.rewind();
}

bool HeadingMatch::are_degrees() const {
  constexpr double kClear = 0.05;
  if (std::abs(in_degrees_.share() - in_radians_.share()) > kClear)
    return in_degrees_.share() > in_radians_.share();
  return most_angle_ > 2.1 * std::numbers::pi;  // more than a turn, on a straight way
}

/// The longer side of the area in which the body moves.
double HeadingMatch::extent(tables::Table& table, const PoseColumns& columns, Slot heading) {
  std::array<double, 2> least{HUGE_VAL, HUGE_VAL}, most{-HUGE_VAL, -HUGE_VAL};
  table.rewind();
  while (table.next()) {
    for (const std::size_t axis : {0U, 1U}) {
      const auto value = number(table, columns[axis == 0 ? Slot::x : Slot::y]);
      if (value) least[axis] = std::min(least[axis], *value), most[axis] = std::max(most[axis], *value);
    }
    if (const auto angle = number(table, columns[heading]))
      most_angle_ = std::max(most_angle_, std::abs(*angle));
  }
  return std::max(most[0] - least[0], most[1] - least[1]);
}

}  // namespace astro::truth
