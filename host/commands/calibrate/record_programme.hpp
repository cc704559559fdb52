#pragma once

#include <filesystem>
#include <vector>

#include "host/experiment/files/plan.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/simulation/study/programme.hpp"

/// Drives that are recorded for a calibration, whatever their kinds.
namespace astro::commands {

struct ProgrammeRun {
  experiment::RunSpec spec;  // without a phase
  double size_m = 0;         // as in recording::RunInfo; 0 for a spin
  robot::Path path;
};

/// Kind by kind as 'plan' lists them, clockwise and counter-clockwise in turn, an odd one clockwise.
std::vector<ProgrammeRun> runs_of(const simulation::study::Programme& programme);

/// Drives those of `runs` that `folder` does not hold yet and records each into a file of its own there.
/// `info`: what is alike in all of them. With `pause` each waits for Enter. Throws astro::Error if the folder
/// holds all of them, and what experiment::record_run throws; runs that were recorded by then stay.
void record_programme(robot::Client& client, truth::Source& truth, const std::vector<ProgrammeRun>& runs,
                      const recording::RunInfo& info, const std::filesystem::path& folder, bool pause);

}  // namespace astro::commands
