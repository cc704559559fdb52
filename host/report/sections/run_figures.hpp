#pragma once

#include <vector>

#include "host/report/page/page.hpp"
#include "host/report/sections/groups.hpp"
#include "host/report/sections/report.hpp"

namespace astro::report {

/// For each group of comparable runs: paths by odometry and ground truth, and errors along the way.
Section run_figures(const ReportInput& input, const std::vector<RunGroup>& groups);

}  // namespace astro::report
