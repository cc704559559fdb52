#pragma once

#include "host/experiment/analysis/results.hpp"
#include "host/report/report.hpp"

namespace astro::experiment {

/// The content of an experiment's report.
report::ReportInput report_input(const Results& results);

}  // namespace astro::experiment
