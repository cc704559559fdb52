#pragma once

#include <optional>
#include <string>

/// Whether a gap that somebody read can be right, and which mistake would explain it.
namespace astro::wall {

/// What a gap is expected to be.
struct ExpectedGap {
  double gap_m = 0;          // by the wheels, with all that is known of them
  double known = 0.01;       // relative standard error of that: 1 % if nobody has read a gap before
  double loaded_m = 0;       // by the factors that the robot carries
  bool read_before = false;  // what is known of them comes from an earlier reading
};

struct GapDoubt {
  enum class Mistake {
    unknown,
    other_unit,     // ten, a hundred or a thousand times as much, or as little
    to_the_axle,    // measured to the middle of the robot
    to_the_rear,    // measured to its rear
    digit_dropped,  // a digit is missing or exchanged
  };
  Mistake mistake = Mistake::unknown;
  double read_m = 0;
  /// False if the gap needs wheels that are more than a fifth larger or smaller than the robot's parameters say. Then the gap
  /// or the robot's wheel diameter, gear or counts is wrong, even if the reader confirms the gap.
  bool possible = true;
  /// A sentence without its full stop: what was read, what is expected, and what would explain it.
  std::string why;
};

/// Nothing if the gap is possible and within 5 mm plus three standard errors of the expected one. `axle_m`: from the front to
/// the axle; `length_m`: of the robot.
std::optional<GapDoubt> doubt_about_gap(double read_m, const ExpectedGap& expected, double axle_m,
                                        double length_m);

}  // namespace astro::wall
