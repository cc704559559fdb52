#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/calibration/clock/clock_search.hpp"
#include "host/calibration/preparation/prepared_run.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// From what was recorded to what the filter can follow, or the sentence why not.
namespace astro::calibration {

/// Which samples of truth are used.
enum class Density {
  all,
  /// No two closer than two samples of the wheels are: what the wheels did between these is a guess that all
  /// truth in between shares, and would count for more than it tells. Rejected: means over as long, for they
  /// smooth the slip, too (K comes out 13 % too small).
  independent
};

/// What of `runs` the estimator uses, and where the clocks stand. `carried` need only be roughly right.
///
/// Throws astro::Error naming the run for
///   no odometry or hardly any truth; odometry lost while the robot moved; a robot that did not move
///   times that run backwards or jump by an hour; values that are no numbers
///   streams that do not overlap, or whose motions have nothing in common
///   a drive that repeats itself, recorded so that nothing tells which lap is which
///   no run but such as are left out
///   headings of truth that never change although the wheels turn the robot
///   truth that turns against the wheels: headings clockwise, axes mirrored, or wheels exchanged
struct PreparedRuns {
  std::vector<PreparedRun> runs;
  std::vector<ClockFit> clocks;  // of each run; zero if the clocks are known
  /// Why a run that spoils nothing is not among them, with the remedy: a spin of unknown clock under
  /// positions that stand still.
  std::vector<std::string> left_out;
};
PreparedRuns prepare(std::span<const Trajectory> runs, const WheelFactors& carried, bool clock_known,
                     Density density);

}  // namespace astro::calibration
