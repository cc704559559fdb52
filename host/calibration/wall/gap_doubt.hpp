#pragma once

#include <optional>
#include <string>

/// Whether a gap that somebody read can be right, and which mistake would explain it.
namespace astro::calibration {

struct GapDoubt {
  enum class Mistake {
    unknown,
    other_unit,     // ten, a hundred or a thousand times as much, or as little
    to_the_axle,    // measured to the middle of the robot
    to_the_rear,    // measured to its rear
    digit_dropped,  // a digit is missing or exchanged
  };
  Mistake mistake = Mistake::unknown;
  std::string why;  // one clause: what was read, what is expected, and what would explain it
};

/// A gap is expected to be `expected_m`, within `known` of it (1 % if the scale of the robot is not known, its standard error if it
/// is) and 5 mm. `axle_m`: from the front to the axle; `length_m`: of the robot.
std::optional<GapDoubt> doubt_about_gap(double read_m, double expected_m, double known, double axle_m,
                                        double length_m);

}  // namespace astro::calibration
