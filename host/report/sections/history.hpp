#pragma once

#include "host/report/page/page.hpp"
#include "host/report/sections/report.hpp"

namespace astro::report {

/// All phases in a row; only for three and more, as two are the parameter table.
Section history(const ReportInput& input);

}  // namespace astro::report
