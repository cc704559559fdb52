#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/gyro/gyro_calibration.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/recording/run.hpp"

/// The gyro of the robot that drove, calibrated beside its wheels.
namespace astro::experiment {

/// The wheels and the gyro of a run, whoever recorded it, without truth; no rates if it has no gyro. Times are seconds since its first
/// odometry sample. The rates of our own robots are those without the bias and the scale that the robot knew.
calibration::GyroDrive gyro_drive(const recording::Run& run, const std::string& name);

/// What shows the gyro's scale: the headings of a tracker; the wheels with the factors found, whose error is part of it; whole turns
/// between two squarings against a wall.
enum class GyroReference { truth, wheels, wall };

struct GyroResult {
  calibration::GyroAgainstWheels against_wheels;  // with the factors found
  /// The turn that the gyro measures over the true one. Of our own robots on top of the scale that was loaded.
  calibration::GyroScale scale;
  GyroReference by = GyroReference::wheels;
  std::vector<std::string> names;  // of the drives
};

/// Nothing if no run has a gyro. `found`: by maximum likelihood or by scans, from these runs. Throws astro::Error of a
/// calibration::GyroProblem.
std::optional<GyroResult> calibrate_gyro(const RunSet& set, const Calibration& found);

/// Scale, lag and bias in a few sentences.
std::string gyro_sentence(const GyroResult& result);
/// Where robot and wheels parted, each with its drive, time and place; empty if nowhere.
std::vector<std::string> slip_sentences(const GyroResult& result);

nlohmann::json to_json(const GyroResult& result);

}  // namespace astro::experiment
