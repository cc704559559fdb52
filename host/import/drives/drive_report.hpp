#pragma once

#include <string>

#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/analysis/dead_reckoning.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/report/report.hpp"

/// A report on drives of any robot, with the factors that it carried and with other ones.
namespace astro::importing {

/// `found`: maximum likelihood over these drives, which says where the tracked body sits and how the clocks are offset; its
/// factors are compared, drive by drive with factors that have not seen the drive.
report::ReportInput drive_report(const experiment::RunSet& set, const experiment::Calibration& found);

/// The same with `factors` of another calibration instead.
report::ReportInput drive_report(const experiment::RunSet& set, const experiment::Calibration& found,
                                 const experiment::NamedFactors& factors);

}  // namespace astro::importing
