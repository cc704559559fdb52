#pragma once

#include <span>
#include <vector>

#include "host/calibration/prepared_run.hpp"

/// Moments at which truth and wheels part: a castor that kicks, a cable underfoot, a hand, a marker taken for
/// another. The factors suffer little from them (huber.hpp); a person wants to know when to look.
namespace astro::calibration {

struct Jolt {
  double time_s = 0;                   // on the tracker's clock
  double since_start_s = 0;            // of the run's truth
  double turned_rad = 0, moved_m = 0;  // by truth, less what the wheels did; turned counter-clockwise
};

/// Of each run, in order of time, at most three; none where truth has no headings. A jolt parts half a second
/// of truth from the half second before eight times as far as other moments do, by at least 20 mrad or 3 % of
/// a wheelbase, and lasts for two seconds. `unknowns` are those of each run, fitted. Cost  linear in the
/// samples.
std::vector<std::vector<Jolt>> jolts(std::span<const PreparedRun> runs, std::span<const Unknowns> unknowns);

}  // namespace astro::calibration
