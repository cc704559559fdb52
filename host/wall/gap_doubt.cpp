#include "host/wall/gap_doubt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace astro::wall {
namespace {

using Mistake = GapDoubt::Mistake;

std::string mm(double length_m) { return fmt::format("{:.0f} mm", 1000 * length_m); }

/// Whether a missing digit of the whole millimetres, or two neighbouring digits that are exchanged, explain
/// the difference.
bool is_slip_of_digits(double read_m, double expected_m, double allowed_m) {
  constexpr double kMost_m = 1000;  // no gap, and too many digits to try
  if (read_m > kMost_m) return false;
  const std::string typed = fmt::format("{:.0f}", 1000 * read_m);
  const auto fits = [&](const std::string& digits) {
    return !digits.empty() && std::abs(std::stod(digits) / 1000 - expected_m) <= allowed_m;
  };
  for (std::size_t i = 0; i < typed.size(); ++i) {
    std::string exchanged = typed;
    if (i + 1 < typed.size()) std::swap(exchanged[i], exchanged[i + 1]);
    if (fits(exchanged)) return true;
  }
  for (std::size_t i = 0; i <= typed.size(); ++i)  // one is missing
    for (char digit = '0'; digit <= '9'; ++digit) {
      std::string longer = typed;
      if (fits(longer.insert(i, 1, digit))) return true;
    }
  return false;
}

bool is_possible(double read_m, const ExpectedGap& expected) {
  constexpr double kFifth = 0.2;
  return std::abs(read_m / expected.loaded_m - 1) <= kFifth;
}

std::string facts_of(double read_m, const ExpectedGap& expected) {
  if (expected.read_before)
    return fmt::format("{} was read, where {} would be right by the reading before", mm(read_m),
                       mm(expected.gap_m));
  return fmt::format("{} was read, and by its wheels the robot has backed off by {}", mm(read_m),
                     mm(expected.gap_m));
}

}  // namespace

std::optional<GapDoubt> doubt_about_gap(double read_m, const ExpectedGap& expected, double axle_m,
                                        double length_m) {
  const double allowed_m = 0.005 + 3 * expected.known * expected.gap_m;
  const auto fits = [&](double gap_m) { return std::abs(gap_m - expected.gap_m) <= allowed_m; };
  const bool possible = is_possible(read_m, expected);
  if (possible && fits(read_m)) return std::nullopt;
  const std::string facts = facts_of(read_m, expected);
  const auto doubt = [&](Mistake mistake, const std::string& explanation) {
    const double larger = 100 * (read_m / expected.loaded_m - 1);
    const std::string impossible =
        possible || larger > 1000
            ? ""
            : fmt::format("; the wheels would be {:.0f} % {} than their diameter, gear and counts say",
                          std::abs(larger), larger > 0 ? "larger" : "smaller");
    return GapDoubt{mistake, read_m, possible, facts + explanation + impossible};
  };
  for (const double times : {10.0, 100.0, 1000.0}) {
    for (const double factor : {times, 1 / times})
      if (fits(read_m * factor))
        return doubt(Mistake::other_unit,
                     fmt::format("; {} would fit, in another unit", mm(read_m * factor)));
  }
  constexpr double kPlace_m = 0.01;  // how well somebody hits a middle or a rear that is not marked
  const double more_m = read_m - expected.gap_m;
  if (std::abs(more_m - axle_m) <= allowed_m + kPlace_m)
    return doubt(Mistake::to_the_axle, "; it would fit if it was measured to the axle, not to the front");
  if (std::abs(more_m - length_m) <= allowed_m + kPlace_m)
    return doubt(Mistake::to_the_rear, "; it would fit if it was measured to the rear, not to the front");
  constexpr double kSlight = 0.02;  // of the gap; 1010 for 1001 explains nothing
  if (std::abs(more_m) > kSlight * expected.gap_m && is_slip_of_digits(read_m, expected.gap_m, allowed_m))
    return doubt(Mistake::digit_dropped, "; a missing digit or two that are exchanged would explain it");
  return doubt(Mistake::unknown, "");
}

}  // namespace astro::wall
