#pragma once

#include <optional>

#include "host/calibration/trajectory.hpp"

/// Where the tracker's clock stands against the robot's, found from the motion alone.
namespace astro::calibration {

/// Robot's time = truth's time + offset_s + skew * (truth's time - the truth's time in the middle of the
/// run).
struct ClockFit {
  double offset_s = 0, skew = 0;
  double correlation = 0;  // of how speeds and turn rates differ from their means, at most 1
  double likeness = 0;     // of speeds and turn rates themselves: near 1 for a steady motion, too

  /// The robot's time of a truth sample; `middle_s`: the truth's time in the middle of the run.
  double robot_time_s(double truth_s, double middle_s) const {
    return truth_s + offset_s + skew * (truth_s - middle_s);
  }
};

/// Slides the one motion along the other until speeds and turn rates correlate best. Clocks that are nearly
/// the same (1 s) are tried first; only where nothing fits there, any offset and a skew within 5 % of `skew`,
/// or, where it is given, `skew` itself. Good to some 10 ms: a start for the likelihood, not a result.
///
/// `wheelbase_m` weighs turning against driving and need only be roughly right. Senses of turning do not
/// matter. Errors  a correlation far below 1 says that the streams belong to different drives; -1 without any
/// overlap. Cost    about 1 ms for a minute, 100 ms where everything has to be tried.
ClockFit search_clock(const Trajectory& run, double wheelbase_m, std::optional<double> skew);

}  // namespace astro::calibration
