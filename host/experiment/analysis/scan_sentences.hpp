#pragma once

#include <string>

#include "host/calibration/judgement/cross_validation.hpp"
#include "host/lidar/scan_calibration.hpp"

/// Results of a calibration by scans in sentences that the terminal, the report and files share.
namespace astro::experiment {

/// A calibration that cannot be judged is not shown to be better.
calibration::Verdict verdict_of(const lidar::ScanCalibration& found);
/// The advice and the reason for it.
std::string verdict_sentence(const lidar::ScanCalibration& found);

/// "By 1204 scans over 86 m, of which 402 pairs were matched."
std::string matches_sentence(const lidar::ScanCalibration& found);
/// Where the scanner sits, which way it looks, and by how much its stamps are late.
std::string scanner_sentence(const lidar::ScanCalibration& found);
/// Which factors are from the drives alone, because that helps on pieces that were not used to find them; "" if none is.
std::string changed_sentence(const lidar::ScanCalibration& found);

}  // namespace astro::experiment
