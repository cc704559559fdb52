#pragma once

#include <span>
#include <vector>

#include "host/calibration/likelihood/innovation.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Moments at which truth turns and the wheels do not: a castor that kicks, a cable underfoot, a hand, a
/// marker taken for another. The factors suffer little from them (huber.hpp); a person wants to know when to
/// look.
namespace astro::calibration {

struct Jolt {
  double time_s = 0;         // on the tracker's clock
  double since_start_s = 0;  // of the run's truth
  double turned_rad = 0;     // by truth less wheels; counter-clockwise
  double moved_m = 0;        // in the same moment
};

/// Of each run, in order of time, at most three; none where truth has no headings. At a jolt half a second of
/// truth (eight samples where that is longer) is turned against the half second before eight times as far as
/// at other moments and by at least 20 mrad, and still is two seconds later: clocks that do not fit turn them
/// apart for the time of a spin alone. Neither the first and last two seconds are judged nor a robot that
/// stands; truth may be lost in the moment itself for up to a second. `unknowns` are those of each run,
/// fitted. Cost  linear in the samples.
std::vector<std::vector<Jolt>> find_jolts(std::span<const PreparedRun> runs,
                                          std::span<const Unknowns> unknowns);

}  // namespace astro::calibration
