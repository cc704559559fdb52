#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/recording/run.hpp"
#include "host/recording/run_file.hpp"

namespace astro::experiment {

/// Recordings that are calibrated together: names[i] is the name of runs[i], and sessions[i] that of its session
/// (calibration::Trajectory::session). If `sessions` is empty, they are found from the data.
struct RunSet {
  std::vector<std::string> names;
  std::vector<recording::Run> runs;
  std::vector<std::string> sessions = {};
};

/// All recordings below `folder` in natural order, named by their path in it without the extension ("square-cw-3",
/// "before/square-cw-3"), except those in `without`: a name, or its last part if only one recording has it.
///
/// Throws astro::Error if nothing is left, if two are copies of one recording, for a name that no recording
/// or more than one has, and what recording::list_runs and recording::read_run throw.
RunSet read_run_set(const std::filesystem::path& folder, std::span<const std::string> without = {},
                    recording::Damage damage = recording::Damage::refused);

}  // namespace astro::experiment
