#pragma once

#include <span>
#include <vector>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Wheels that run out of true: once per turn a wheel's travel leads its reading and lags behind it, because its rim, its gear
/// or its encoder sits off the axis. Worth knowing and worth a screwdriver, but not corrected for: a robot does not know where its
/// wheels stand when it is switched on.
namespace astro::calibration {

struct Eccentricity {
  double amplitude_m = 0, standard_error_m = 0;  // of the travel
  /// For each run that shows it: the angle of the wheel, since the beginning of its counts in this run, at which its travel leads most.
  std::vector<double> phases_rad;
  bool significant = false;  // by four standard errors
};

struct Eccentricities {
  Eccentricity left, right;
};

/// From the headings of truth against those of the wheels, over half a turn of the wheels each, where the robot drives on. What a
/// wheel does once per turn is compared with what it seems to do 0.6 to 1.6 times per turn, which is noise and slip.
///
/// `clocks` and `factors` are the fitted ones; `clocks` has one entry for each run. Runs without headings, without a known turn of
/// the wheels (Trajectory::wheel_turn_m) or with hardly any distance say nothing; if none does, both amplitudes are 0 and their errors infinite.
/// Cost  linear in the samples.
Eccentricities find_eccentricities(std::span<const PreparedRun> runs, std::span<const ClockFit> clocks,
                                   const WheelFactors& factors);

}  // namespace astro::calibration
