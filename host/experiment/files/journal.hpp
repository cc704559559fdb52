#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/experiment/files/plan.hpp"

namespace astro::experiment {

enum class JournalProblem {
  no_experiment,
  damaged  // values: the file, and those of the error that its plan gives
};

/// experiment.json: what a folder's experiment is and how far it went, so that it can be resumed. The runs
/// themselves are the files beside it.
struct Journal {
  Plan plan;
  std::string robot_id, robot_name, board, firmware, started_at;
  /// The factors loaded in the robot when a phase began, by phase.
  std::map<std::string, calibration::WheelFactors> loaded;
  /// Recordings whose ground truth looks mistyped, but which a person has confirmed:
  /// "before/square-cw-3.mcap".
  std::set<std::string> confirmed;
};

bool has_journal(const std::filesystem::path& folder);

/// Throws astro::Error naming the file: not there, not ours, damaged.
Journal read_journal(const std::filesystem::path& folder);
void write_journal(const std::filesystem::path& folder, const Journal& journal);

}  // namespace astro::experiment
