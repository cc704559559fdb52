#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/motion/clock_search.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/prepared_run.hpp"

/// Prepares recorded runs for the filter, or says in one sentence why a run cannot be used.
namespace astro::calibration {

/// Which samples of truth are used.
enum class Density {
  all,
  /// No two samples are closer than two samples of the wheels. In between, the travel of the wheels is interpolated, so the
  /// errors of all truth samples there would be correlated and count too much. They are not averaged instead, because that
  /// smooths the slip as well (K comes out 13 % too small).
  independent
};

struct PreparedRuns {
  std::vector<PreparedRun> runs;
  std::vector<ClockFit> clocks;  // of each run; zero if the clocks are known
  /// The reason and the remedy for each run that is left out without harm: a spin during which the positions stand still, so
  /// that they show neither its clock offset nor its rotation; a clock that was set anew at a moment that no stamp shows.
  std::vector<Remark> left_out;
  std::vector<Remark> mended;  // what was done to runs that are used
};

/// The samples of `runs` that the estimator uses, and the offsets of their clocks. `loaded` need only be roughly
/// right.
///
/// Throws astro::Error naming the run for
///   no odometry or hardly any truth; odometry lost in most of the drive; a robot that did not move
///   times that run backwards or jump by an hour; values that are no numbers
///   streams that do not overlap, or whose motions have nothing in common
///   a drive that repeats itself, recorded so that nothing shows which lap is which
///   no usable run
///   headings of truth that never change although the wheels turn the robot
///   truth that turns the other way than the wheels: headings clockwise, axes mirrored, or wheels exchanged
PreparedRuns prepare(std::span<const Trajectory> runs, const WheelFactors& loaded, bool clock_known,
                     Density density);

}  // namespace astro::calibration
