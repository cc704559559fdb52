#pragma once

#include "host/experiment/analysis/results.hpp"
#include "host/report/report.hpp"

namespace astro::experiment {

/// What the report of an experiment says.
report::ReportInput report_input(const Results& results);

}  // namespace astro::experiment
