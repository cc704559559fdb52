#pragma once

#include <span>
#include <vector>

#include "host/experiment/film/motion_rates.hpp"

namespace astro::experiment {

/// A place that is by so little less alike fits as well.
inline constexpr double kRival = 0.02;

/// Where in a film a run is: robot's time = film's time + offset_s.
struct Placement {
  double offset_s = 0;
  Likeness likeness = {};  // of the rates there
  bool ambiguous = false;  // another place fits as well, and only the order of the runs decided
};

/// Places all runs in one film by sliding their rates along it. Runs that one clock of the robot timed one after the other share
/// one offset, so a square that is driven five times is not taken for another; where the clocks overlap (each log begins
/// at zero), each run is placed alone, and where several places fit, in the order of the runs.
///
/// `order`  of the runs in time, as far as it is known: indices of `runs`
/// Errors   none; a run that is not in the film has a likeness far below 1.
/// Cost     a minute of runs in an hour of film: 0.1 s.
std::vector<Placement> place_runs(std::span<const MotionRates> runs, const MotionRates& film,
                                  std::span<const std::size_t> order);

}  // namespace astro::experiment
