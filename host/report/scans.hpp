#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/report/page.hpp"
#include "host/report/report.hpp"

namespace astro::report {

/// The walls by both sets of factors side by side, and the residuals along the way. Without scans the section is empty.
Section scan_section(const ReportInput& input);

/// Its numbers, as web/report.js reads them: {"maps": [{"x", "y"}], "way": [...], "residuals": [{"x", "y", "h"}]}; before and after.
/// Units: m, and mm and mrad in the residuals. Null without scans.
nlohmann::json scan_data(const ReportInput& input);

}  // namespace astro::report
