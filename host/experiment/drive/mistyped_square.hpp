#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/experiment/files/plan.hpp"
#include "host/recording/run/run.hpp"

namespace astro::experiment {

struct MistypedSquare {
  std::string why;             // names the run, its value and that of the others
  std::filesystem::path file;  // of an earlier run; empty: it is the new one
};

/// Whether `run`, a square of which the ground truth was just entered, or one of those that `folder` holds of
/// the same phase and direction, looks mistyped compared with the others (host/calibration/end_poses/odd_run.hpp).
std::optional<MistypedSquare> mistyped_square(const std::filesystem::path& folder, const Plan& plan,
                                              const RunSpec& spec, const recording::Run& run);

}  // namespace astro::experiment
