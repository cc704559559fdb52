#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/end_poses/robust_fit.hpp"

/// Runs whose end does not fit those of the other runs, and the mistake of a person that would explain it.
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
  double chi_square = 0;  // how far it is from what all other runs let expect (Surprise)
  std::optional<Mistake> mistake;
};

/// The runs that do not fit, each judged by a fit of all other runs: first those that a mistake explains, then those that
/// are farthest off. A run is odd if an honest one would be so far off once in ten thousand.
///
/// A single square is judged, too: whatever the wheels and the wheelbase are, x, y and heading belong together, so that
/// a changed sign shows at once. A dropped digit may show only when more runs of its direction are there. While two runs of a
/// direction contradict each other, both are odd. If most runs of a direction are odd and all of it agree with each other,
/// none is: not one number is wrong then, but an axis or the robot.
///
/// Errors  none: ends that nothing explains are no odd runs but no runs at all, and the estimate says so.
std::vector<OddRun> odd_runs(std::span<const SquareEnd> cw, std::span<const SquareEnd> ccw,
                             const SquareSetup& setup);

/// "x = -22 mm, y = -260 mm, heading 8.7 degrees, and about x = -228 mm, y = -230 mm, heading 8.6 degrees is to be expected;
/// x = -220 mm would fit (the decimal point of x)"
std::string described(const OddRun& odd);

}  // namespace astro::calibration
