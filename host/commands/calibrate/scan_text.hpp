#pragma once

#include <string>

#include "host/lidar/scan_calibration.hpp"

namespace astro::commands {

/// A calibration by scans as a table and sentences, at most 80 columns wide.
std::string scan_result_text(const lidar::ScanCalibration& found);

}  // namespace astro::commands
