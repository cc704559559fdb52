#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "host/calibration/end_poses/end_pose.hpp"

namespace astro::calibration {

/// A run whose end pose looks mistyped: one of its numbers is far from the same number of all other runs, and
/// with its decimal point moved by one, two or three places it would be among them.
struct OddRun {
  std::size_t index = 0;
  const char* coordinate = "";   // "x", "y" or "theta"
  double value = 0, others = 0;  // metres or radians; others: their median
};

/// The run that stands out most among runs that were driven alike, or none. Needs at least three runs, because
/// with two it is undecided which is wrong. `side_m` is the side of their square. Far means five times as far from the median of the
/// others as the farthest of these, and at least by 2.5 % of the side (1.5 degrees for a heading), twice that
/// if the others scatter about 0: runs of one robot scatter by less (Borenstein & Feng: 1 % of a side of 4
/// m).
std::optional<OddRun> mistyped_run(std::span<const EndPose> runs, double side_m);

/// "x = 3.1 m, and 0.31 m in the others, as if its decimal point were misplaced"
std::string described(const OddRun& odd);

}  // namespace astro::calibration
