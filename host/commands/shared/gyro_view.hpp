#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/analysis/gyro_runs.hpp"

/// The gyro of a robot that was calibrated, as a person reads it. Lines of at most 80 columns.
namespace astro::commands {

/// The gyro of the robot that drove, if it has one. One that cannot be calibrated is told, and the wheels' result counts without it.
std::optional<experiment::GyroResult> gyro_of(const experiment::RunSet& set,
                                              const experiment::Calibration& found);

/// Scale, lag and bias, and how our own robot learns of a scale that is surely another one.
std::string gyro_text(const experiment::GyroResult& gyro);

/// Where the robot slipped by its gyro, a warning for each, which says that these seconds are left out.
std::string slips_text(const calibration::GyroAgainstWheels& wheels, const std::vector<std::string>& names);

}  // namespace astro::commands
