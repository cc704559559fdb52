#pragma once

#include <span>
#include <vector>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Finds wheels that run out of true. The rim, the gear or the encoder sits off the axis, so once per turn the wheel's travel
/// first leads and then lags behind its reading. The result is for a person who can correct the wheel. It is not compensated,
/// because a robot does not know the angles of its wheels when it is switched on.
namespace astro::calibration {

struct Eccentricity {
  double amplitude_m = 0, standard_error_m = 0;  // of the travel
  /// One entry for each run that was used: the wheel's angle, from the start of its counts in this run, at which its travel
  /// leads most.
  std::vector<double> phases_rad;
  bool significant = false;  // by four standard errors
};

struct Eccentricities {
  Eccentricity left, right;
};

/// Compares the heading changes of truth and of the wheels over half a wheel turn each, where the robot neither spins nor turns
/// back. The wave once per wheel turn is compared with the waves 0.6 to 1.6 times per turn, which are noise and slip.
///
/// `clocks` and `factors` are the fitted ones; `clocks` has one entry for each run. A run is skipped if it has no headings or
/// no known wheel turn (Trajectory::wheel_turn_m), or if it is too short or too straight. If all are skipped, both amplitudes
/// are 0 and their standard errors infinite.
/// Cost  linear in the samples.
Eccentricities find_eccentricities(std::span<const PreparedRun> runs, std::span<const ClockFit> clocks,
                                   const WheelFactors& factors);

}  // namespace astro::calibration
