#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "host/experiment/analysis/calibration_file.hpp"
#include "host/lidar/scan_calibration.hpp"

/// A calibration by scans in words, as JSON, and as a file to be loaded.
namespace astro::commands {

/// A calibration that cannot be judged is not shown to be better.
calibration::Verdict verdict_of(const lidar::ScanCalibration& found);

/// The advice and the reason for it.
std::string verdict_sentence(const lidar::ScanCalibration& found);

/// Absolute factors with the errors of another day, the verdict, and the wheel that they refer to if it is known.
experiment::ParameterFile parameter_file_of(const lidar::ScanCalibration& found,
                                            const std::optional<experiment::NominalWheel>& wheel);

/// "method": "scan", factors and their errors, the scanner's place, what was matched, and the verdict.
nlohmann::json to_json(const lidar::ScanCalibration& found);

/// A table and sentences, at most 80 columns wide.
std::string scan_result_text(const lidar::ScanCalibration& found);

}  // namespace astro::commands
