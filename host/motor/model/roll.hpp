#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "host/base/error.hpp"

/// Counts per revolution from rolling the robot by hand along a tape measure.
namespace astro::motor {

/// What a roll finds. Values: the ratio that was found and the robot's (other_gear); counted over expected
/// counts of the left and the right wheel (wheels_differ); the wheel (counts_nothing).
enum class RollProblem {
  other_decoding,
  other_gear,
  other_diameter,
  wheels_differ,
  counts_nothing,
  too_short,
  unlikely_length
};

/// The counts of a roll, and the robot's parameters.
struct Roll {
  std::array<double, 2> counts{};  // left, right; signs do not matter
  double counts_per_motor_rev = 0, gear_ratio = 0, wheel_diameter_m = 0;
  /// What was measured: one of them.
  std::optional<double> distance_m, turns;
};

struct RollVerdict {
  std::array<double, 2> ratio{};  // counts that were seen over counts that the parameters lead to expect
  Remark finding;
  bool agrees = false;                       // within what a tape measure and an eye can tell
  std::map<std::string, double> parameters;  // to change, by name
};

/// A ratio within 5 % of 1/8, 1/4, 1/2, 2, 4 or 8 means that the decoder counts other edges than assumed, or
/// another encoder: it changes counts_per_motor_rev. Any other ratio changes the gear if turns were counted, and
/// otherwise the wheel diameter. Wheels that disagree by more than 5 % change nothing. Within 3 % nothing is
/// changed, because a calibration measures that better.
/// Throws astro::Error if the wheels turned less than half a turn, counted next to nothing, or counted five
/// times as much or as little as the length explains and no decoding does.
RollVerdict judge_roll(const Roll& roll);

}  // namespace astro::motor
