#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/experiment/analysis/calibration_file.hpp"
#include "host/wall/wall_experiment.hpp"
#include "host/wall/wall_judgement.hpp"

/// A calibration in front of a wall as a file to be loaded, and as JSON.
namespace astro::wall {

/// Absolute factors with errors, covariance, the robot, the wheel that they refer to, and the verdict.
experiment::ParameterFile parameter_file_of(const WallResult& result, const WallJudgement& judgement);

/// "method": "wall", factors and their errors, E_d, b / S and S, the loaded factors, how it was driven, and the verdict;
/// numbers that do not exist are null. "gyro" of a robot that uses one, as calibrations by other truth have it.
nlohmann::json to_json(const WallResult& result, const WallJudgement& judgement);

}  // namespace astro::wall
