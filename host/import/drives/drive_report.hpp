#pragma once

#include <string>

#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/analysis/dead_reckoning.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/report/report.hpp"

/// A report on drives of any robot, which compares the factors loaded in the robot with others.
namespace astro::importing {

/// `found` is the maximum likelihood estimate over these drives. It gives the lever arm of the tracked body
/// and the clock offsets. The comparison of each drive uses factors that were estimated without this drive.
report::ReportInput drive_report(const experiment::RunSet& set, const experiment::Calibration& found);

/// The same, but compares with `factors` of another calibration.
report::ReportInput drive_report(const experiment::RunSet& set, const experiment::Calibration& found,
                                 const experiment::NamedFactors& factors);

}  // namespace astro::importing
