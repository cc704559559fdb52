#pragma once

#include <span>
#include <vector>

#include "host/calibration/clock_search.hpp"
#include "host/calibration/end_pose.hpp"
#include "host/calibration/innovation.hpp"

/// From what was recorded to what the filter can follow, or the sentence why not.
namespace astro::calibration {

/// Which samples of truth are used.
enum class Density {
  all,
  /// No two closer than 50 ms or than two samples of the wheels. What the wheels do between their samples,
  /// and what the tracker gets wrong for a moment, is shared by all truth in between and would count for more
  /// than it tells. Costs 2 % of the precision where the noise is white, and saves two thirds of the time.
  /// Rejected: means over as long, for they smooth the slip, too (K comes out 13 % too small).
  independent
};

/// What of `runs` the estimator uses, and where the clocks stand. `carried` need only be roughly right.
///
/// Throws astro::Error naming the run for
///   no odometry or hardly any truth; a robot that did not move; times that run backwards
///   streams that do not overlap, or whose motions have nothing in common
///   headings of truth that never change although the wheels turn the robot
///   truth that turns against the wheels: headings clockwise, axes mirrored, or wheels exchanged
struct PreparedRuns {
  std::vector<PreparedRun> runs;
  std::vector<ClockFit> clocks;  // of each run; zero if the clocks are known
};
PreparedRuns prepare(std::span<const Trajectory> runs, const WheelFactors& carried, bool clock_known,
                     Density density);

/// Dead reckoning by `factors` at the times of the prepared truth, from pose (0, 0, 0) at the first.
std::vector<BodySample> dead_reckoned(const PreparedRun& run, const ClockFit& clock,
                                      const WheelFactors& factors);

/// The rigid motion, or its mirror image, that carries one path closest to another.
struct RigidFit {
  double rotation_rad = 0, x_m = 0,
         y_m = 0;  // to = R(rotation) * from + (x, y), y of `from` negated if mirrored
  double rms_m = 0;
};
RigidFit fit_rigid(std::span<const BodySample> from, std::span<const BodySample> to, bool mirrored);

}  // namespace astro::calibration
