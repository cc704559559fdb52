#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/end_poses/robust_fit.hpp"

/// Finds runs whose end does not fit the other runs, and the typing or measuring mistake that would explain
/// it.
namespace astro::calibration {

/// The end of a square in its start frame; a heading that was not measured is NaN.
struct SquareEnd {
  EndPose measured;
  EndPose odometry = {};  // {} where only the errors are known: `measured` is then the error

  EndPose error() const;
};

/// A mistake that is easily made, and what was probably meant.
struct Mistake {
  std::string name;  // "the decimal point of x"
  EndPose meant;
};

struct OddRun {
  Sense sense = Sense::cw;
  std::size_t index = 0;  // within its direction
  EndPose measured, expected;
  double chi_square = 0;  // distance from the prediction of all other runs (Surprise)
  std::optional<Mistake> mistake;
};

/// The runs that do not fit a fit of all other runs. Those that a mistake explains come first, and otherwise the farthest
/// first. A run is odd if a run without a mistake would be so far off only once in ten thousand.
///
/// Where the other runs scatter twice as far as slip explains, no mistake is named: a robot that slips so much does not
/// differ from a person who mistypes. A single square is judged, too: its x, y and heading are related for any wheels and wheelbase, so a wrong sign shows at
/// once. A dropped digit may show only if there are more runs of its direction. As long as a direction has only two runs and
/// these contradict each other, both are odd. If most runs of a direction are odd but all of them agree with each other, none
/// of them is reported, because then an axis or the robot is wrong and not a single number.
///
/// Errors  none. If no ratios explain the ends at all, the result is empty, and the estimate throws instead.
std::vector<OddRun> odd_runs(std::span<const SquareEnd> cw, std::span<const SquareEnd> ccw,
                             const SquareSetup& setup);

/// "x = -22 mm, y = -260 mm, heading 8.7 degrees, and about x = -228 mm, y = -230 mm, heading 8.6 degrees is to be expected;
/// x = -220 mm would fit (the decimal point of x)"
std::string described(const OddRun& odd);

}  // namespace astro::calibration
