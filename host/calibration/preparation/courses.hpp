#pragma once

#include <span>
#include <vector>

#include "host/calibration/preparation/prepared_run.hpp"

namespace astro::calibration {

/// The course of each run, numbered from 0 in the order of first runs. Runs of one session have the same course if their path
/// lengths and their net turns (right wheel minus left wheel) agree within 5 % of the path, for instance squares of one size,
/// driven clockwise. A chance match does no harm, because the errors of such runs at equal places are not correlated.
///
/// Cost  number of runs times number of courses.
std::vector<int> find_courses(std::span<const PreparedRun> runs);

}  // namespace astro::calibration
