#pragma once

#include <span>

#include "host/experiment/analysis/calibration.hpp"
#include "host/lidar/scanned_drive.hpp"
#include "host/report/report.hpp"

namespace astro::experiment {

/// The figures of a calibration by scans: the map is of the drive on which both sets of factors differ most. mirrored: as it was
/// calibrated. Precondition: at least one drive.
report::ScanFigures scan_figures(const lidar::ScanCalibration& found,
                                 std::span<const lidar::ScannedDrive> drives, bool mirrored);

/// The report of drives by their scans, where no experiment was driven.
report::ReportInput scan_report(const Calibration& found, std::span<const lidar::ScannedDrive> drives,
                                bool mirrored);

}  // namespace astro::experiment
