#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "host/experiment/analysis/calibration_file.hpp"
#include "host/lidar/scan_calibration.hpp"

/// A calibration by scans as advice, as JSON, and as a file to be loaded.
namespace astro::importing {

/// Of c_R, c_L and b.
double standard_error(const lidar::ScanCalibration& found, int index);

/// (c_R + c_L) / 2, and c_R / c_L with its relative standard error.
double mean_scale(const calibration::WheelFactors& factors);
double diameter_ratio(const calibration::WheelFactors& factors);
double diameter_ratio_error(const lidar::ScanCalibration& found);

/// A calibration that cannot be judged is not shown to be better.
calibration::Verdict verdict_of(const lidar::ScanCalibration& found);

/// The advice and the reason for it.
std::string verdict_sentence(const lidar::ScanCalibration& found);

/// Absolute factors with the errors of another day, the verdict, and the wheel that they refer to if it is known.
experiment::ParameterFile parameter_file_of(const lidar::ScanCalibration& found,
                                            const std::optional<experiment::NominalWheel>& wheel);

/// "method": "scan", factors and their errors, the scanner's place, what was matched, and the verdict.
nlohmann::json to_json(const lidar::ScanCalibration& found);

}  // namespace astro::importing
