#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/calibration/judgement/path_errors.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/files/run_set.hpp"

/// How well factors dead-reckon recorded drives of any kind: tests a calibration on drives that it has not seen,
/// without driving again.
namespace astro::experiment {

struct NamedFactors {
  std::string name;  // "carried", or the file's path
  calibration::WheelFactors factors;
  RobotIdentity robot{};  // for which they were found; empty if the file does not name it
};

/// Those of calib.toml. `wheel`: the nominal wheel of the drives, to which c_R and c_L refer.
/// Throws astro::Error naming the file if it lacks one of the three or is for another nominal wheel, and what
/// read_parameter_file throws.
NamedFactors factors_of_file(const std::filesystem::path& file, const NominalWheel& wheel);

struct DeadReckoning {
  NamedFactors by;
  calibration::PathErrors errors;  // runs in the order and by the names of the set, but for those left out
};

/// Throws astro::Error: see trajectories_of and calibration::path_errors.
std::vector<DeadReckoning> dead_reckon(const RunSet& set, std::span<const NamedFactors> factors,
                                       MlChoice::Clock clock = MlChoice::Clock::automatic);

}  // namespace astro::experiment
