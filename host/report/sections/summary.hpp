#pragma once

#include "host/report/page/page.hpp"
#include "host/report/sections/report.hpp"

namespace astro::report {

/// The largest systematic error of the square in each phase, and the improvement in words.
Section headline(const ReportInput& input);

/// Where the squares ended: the clusters of end errors of each phase.
Section scatter(const ReportInput& input);

}  // namespace astro::report
