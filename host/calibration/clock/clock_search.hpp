#pragma once

#include <optional>

#include "host/calibration/motion/trajectory.hpp"

/// Where the tracker's clock stands against the robot's, found from the motion alone.
namespace astro::calibration {

/// Robot's time = truth's time + offset_s + skew * (truth's time - the truth's time in the middle of the
/// run).
struct ClockFit {
  double offset_s = 0, skew = 0;
  double correlation =
      0;                // of how speeds and turn rates differ from their means, noise allowed for; at most 1
  double likeness = 0;  // of speeds and turn rates themselves: near 1 for a steady motion, too
  /// Another offset that fits as well within noise: the drive repeats itself.
  std::optional<double> rival_offset_s = {};

  /// The robot's time of a truth sample; `middle_s`: the truth's time in the middle of the run.
  double robot_time_s(double truth_s, double middle_s) const {
    return truth_s + offset_s + skew * (truth_s - middle_s);
  }
};

/// Slides the one motion along the other until speeds and turn rates correlate best. Clocks that are nearly
/// the same (1 s) are tried first; only where nothing fits there, or something else surely fits better, any
/// offset and a skew within 5 % of none, or, where it is given, `skew` itself. Good to some 10 ms, with 5 cm
/// of noise to 0.2 s: a start for the likelihood, not a result.
///
/// Truth without headings does not tell turning; bodies at some levers ahead of the centre are tried, so that
/// a spin is seen by where the body goes round.
///
/// Of offsets that fit alike within noise one within 1 s is taken: clocks stand that near by design, and by
/// chance in one drive of many. Otherwise `rival_offset_s` says that the choice is none.
///
/// `wheelbase_m` weighs turning against driving and need only be roughly right. Senses of turning do not
/// matter. Errors  a correlation far below 1 says that the streams belong to different drives; -1 without any
/// overlap. Cost    about 1 ms for a minute; at most 0.5 s where everything has to be tried, also for a
/// minute in a take of an hour; three times that without headings.
ClockFit search_clock(const Trajectory& run, double wheelbase_m, std::optional<double> skew);

}  // namespace astro::calibration
