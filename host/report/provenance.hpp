#pragma once

#include "host/report/page.hpp"
#include "host/report/report.hpp"

namespace astro::report {

/// Where the figures come from: robot, recordings, method, definitions and notes.
Section provenance(const ReportInput& input);

}  // namespace astro::report
