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
/// odometry sample. The rates of our own robots are those with the loaded scale, less a bias that is the same in the whole drive.
calibration::GyroDrive gyro_drive(const recording::Run& run, const std::string& name);

/// Where the robot of each run turned without its wheels, on the clock of its trajectory: by the gyro, with the factors that the first
/// run had loaded. Nothing where no gyro can be compared with the wheels.
std::vector<std::vector<calibration::Slip>> slips_by_gyro(const RunSet& set);

/// Each of `drives`, made of the runs in their order, with the slips of its run.
void add_slips(auto& drives, const RunSet& set) {
  const std::vector<std::vector<calibration::Slip>> slips = slips_by_gyro(set);
  for (std::size_t i = 0; i < slips.size(); ++i) drives[i].slips = slips[i];
}

/// What shows the gyro's scale: the headings of a tracker; the wheels with the factors found, whose error is part of it; whole turns
/// between two squarings against a wall.
enum class GyroReference { truth, wheels, wall };

struct GyroResult {
  calibration::GyroAgainstWheels against_wheels;  // with the factors found
  /// The turn that the gyro measures over the true one. Of our own robots on top of the scale that was loaded.
  calibration::GyroScale scale;
  GyroReference by = GyroReference::wheels;
  std::vector<std::string> names;  // of the drives
  /// The parameter gyro_scale that our own robot had. Nothing of other robots, or if drives had different ones.
  std::optional<double> loaded_scale = {};

  /// What gyro_scale should be. Nothing if it is not known what it was, or if the gyro turns the other way, which is a matter of gyro_axis.
  std::optional<double> parameter() const;
};

/// Nothing if no run has a gyro. `found`: by maximum likelihood or by scans, from these runs. Throws astro::Error of a
/// calibration::GyroProblem.
std::optional<GyroResult> calibrate_gyro(const RunSet& set, const Calibration& found);

/// What wheels and gyro show without any ground truth. The scale S of the wheels is that of the loaded factors.
struct GyroAlone {
  calibration::GyroAgainstWheels against_wheels;
  calibration::WheelFactors loaded, factors;  // the wheelbase if the gyro's scale is right
  double E_d_se = 0;
  double b_se_m = 0;               // with the error of the gyro's scale
  std::vector<std::string> names;  // of the drives
};

/// `scale_error`: relative standard error of the gyro's scale. Throws astro::Error of a calibration::GyroProblem.
GyroAlone factors_by_gyro(const RunSet& set, double scale_error);

nlohmann::json to_json(const GyroAlone& result);

/// Scale, lag and bias in a few sentences.
std::string gyro_sentence(const GyroResult& result);
/// Lag and bias.
std::string timing_sentence(const calibration::GyroAgainstWheels& wheels);
/// Where robot and wheels parted, each with its drive, time and place; empty if nowhere. `names`: of the drives.
std::vector<std::string> slip_sentences(const calibration::GyroAgainstWheels& wheels,
                                        const std::vector<std::string>& names);

/// Both as notes of a report.
std::vector<std::string> notes_of(const GyroResult& result);

nlohmann::json to_json(const GyroResult& result);

}  // namespace astro::experiment
