#pragma once

#include <filesystem>
#include <vector>

#include "host/experiment/drive/record_run.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/simulation/study/programme.hpp"

/// Drives of any kind that are recorded for a calibration.
namespace astro::commands {

struct ProgrammeRun {
  experiment::RunSpec spec;  // without a phase
  double size_m = 0;         // as in recording::RunInfo; 0 for a spin
  robot::Path path;
};

/// The runs kind by kind as 'plan' lists them, alternating clockwise and counter-clockwise, an odd one
/// clockwise.
std::vector<ProgrammeRun> runs_of(const simulation::study::Programme& programme);

/// Drives those of `runs` that are not in `folder` yet and records each into a file of its own there. `info`:
/// what is the same in all of them. With `pause` each run waits for Enter. Throws astro::Error if the folder
/// holds all of them, and what experiment::record_run throws; runs that were recorded by then stay.
void record_programme(robot::Client& client, truth::Source& truth, const std::vector<ProgrammeRun>& runs,
                      const recording::RunInfo& info, const std::filesystem::path& folder, bool pause);

}  // namespace astro::commands
