#pragma once

#include "host/report/page/page.hpp"
#include "host/report/sections/report.hpp"

namespace astro::report {

/// The parameters before and after, with standard errors.
Section parameter_table(const ReportInput& input);

/// Figures of merit of the squares, phase by phase, with improvement factors. Empty for fewer than two phases.
Section factor_table(const ReportInput& input);

/// The end error of every square.
Section rms_tables(const ReportInput& input);

}  // namespace astro::report
