#pragma once

#include "host/report/page.hpp"
#include "host/report/report.hpp"

/// The tables of the page, in the order in which they stand there.
namespace astro::report {

/// The verdict on drives of any shape, and each drive with the factors before and after. Empty without a comparison.
Section drive_comparison(const ReportInput& input);

/// The parameters before and after, with standard errors.
Section parameter_table(const ReportInput& input);

/// The loaded factors of all phases. Empty if a phase lacks them, and for fewer than three phases, because the parameter
/// table shows two.
Section history(const ReportInput& input);

/// Figures of merit of the squares, phase by phase, with improvement factors. Empty for fewer than two phases.
Section factor_table(const ReportInput& input);

/// The end error of every square.
Section rms_tables(const ReportInput& input);

}  // namespace astro::report
