#pragma once

#include "host/report/page/page.hpp"
#include "host/report/sections/report.hpp"

namespace astro::report {

/// Where the figures come from: robot, recordings, method, definitions and notes.
Section provenance(const ReportInput& input);

}  // namespace astro::report
