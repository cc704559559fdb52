#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/calibration/judgement/path_errors.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/files/run_set.hpp"

/// Dead-reckons recorded drives of any kind with given factors. This tests a calibration on hold-out drives, without driving
/// again.
namespace astro::experiment {

struct NamedFactors {
  std::string name;  // "carried", or the file's path
  calibration::WheelFactors factors;
  RobotIdentity robot{};  // for which they were found; empty if the file does not name it
};

/// The factors of calib.toml. `wheel`: the nominal wheel of the drives, to which c_R and c_L refer. Throws astro::Error
/// naming the file if it lacks c_R, c_L or b or is for another nominal wheel, and what read_parameter_file throws.
NamedFactors factors_of_file(const std::filesystem::path& file, const NominalWheel& wheel);

struct DeadReckoning {
  NamedFactors by;
  calibration::PathErrors errors;  // in the order and by the names of the set, without the runs left out
};

/// Throws astro::Error: see trajectories_of and calibration::path_errors.
std::vector<DeadReckoning> dead_reckon(const RunSet& set, std::span<const NamedFactors> factors,
                                       MlChoice::Clock clock = MlChoice::Clock::automatic);

}  // namespace astro::experiment
