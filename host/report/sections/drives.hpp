#pragma once

#include "host/report/page/page.hpp"
#include "host/report/sections/report.hpp"

namespace astro::report {

/// The verdict on drives of any shape, and each drive with the factors before and after. Empty without a comparison.
Section drive_comparison(const ReportInput& input);

}  // namespace astro::report
