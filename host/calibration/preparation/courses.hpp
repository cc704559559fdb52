#pragma once

#include <span>
#include <vector>

#include "host/calibration/preparation/prepared_run.hpp"

namespace astro::calibration {

/// The course of each run, numbered from 0 in the order of their first runs. Runs of one session repeat a course if their wheels went equally
/// far and turned the robot equally far the same way round, both within a twentieth of the path: squares of one size, driven clockwise. Runs
/// that are alike by chance do no harm, because their errors at equal places have nothing in common.
///
/// Cost  the runs times the courses.
std::vector<int> find_courses(std::span<const PreparedRun> runs);

}  // namespace astro::calibration
