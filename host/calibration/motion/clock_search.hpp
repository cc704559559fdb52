#pragma once

#include <optional>

#include "host/calibration/motion/trajectory.hpp"

/// Offset and skew between the tracker's clock and the robot's clock, from the motion alone.
namespace astro::calibration {

/// Robot's time = truth's time + offset_s + skew * (truth's time - the truth's time in the middle of the
/// run).
struct ClockFit {
  double offset_s = 0, skew = 0;
  double correlation = 0;  // of speeds and turn rates about their means, corrected for noise; at most 1
  double likeness = 0;     // of speeds and turn rates themselves: near 1 for a steady motion as well
  /// Another offset that fits as well within noise, because the drive repeats itself.
  std::optional<double> rival_offset_s = {};

  /// The robot's time of a truth sample; `middle_s`: the truth's time in the middle of the run.
  double robot_time_s(double truth_s, double middle_s) const {
    return truth_s + offset_s + skew * (truth_s - middle_s);
  }
};

/// Shifts one motion along the other until speeds and turn rates correlate best. Offsets within 1 s are tried
/// first. If none fits there, or another one certainly fits better, every offset is tried, with a skew within
/// 5 % of zero or, if it is given, with `skew`. The offset is good to some 10 ms, with 5 cm of noise to 0.2 s:
/// it is a start value for the likelihood, not a result.
///
/// Truth without headings does not show turning. So the search also assumes bodies at some distances ahead of
/// the centre, whose positions show a spin.
///
/// If several offsets fit equally well within noise, one within 1 s is taken, because synchronised clocks are that close and
/// others seldom are. Otherwise `rival_offset_s` says that the choice is ambiguous.
///
/// `wheelbase_m` weighs turning against driving and need only be roughly right. The directions of turning do
/// not matter.
///
/// Errors  none. A correlation far below 1 means that the streams belong to different drives; it is -1
///         without any overlap.
/// Cost    about 1 ms for a minute; at most 0.5 s if everything has to be tried, also for a minute within an
///         hour; three times that without headings.
ClockFit search_clock(const Trajectory& run, double wheelbase_m, std::optional<double> skew);

}  // namespace astro::calibration
