#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/experiment/files/plan.hpp"
#include "host/experiment/files/run_set.hpp"

namespace astro::experiment {

/// Gives runs their truth; those that get none stay without. May throw to end the experiment for now.
///
/// `others`  the films of earlier phases (RunInfo::truth_film), which cannot show these runs, though the robot drives the same there
using GiveTruth =
    std::function<void(const std::string& phase, RunSet& set, const std::vector<std::string>& others)>;

/// Completes the recordings of a phase whose truth comes after all of them (truth::LaterSource): `give` gets the runs that have
/// none, and is asked again until none is left. What has truth is kept on the disk at once. False if nothing was missing.
bool complete_later(const std::filesystem::path& folder, const std::vector<RunSpec>& specs,
                    const std::string& source, const std::vector<std::string>& others, const GiveTruth& give);

}  // namespace astro::experiment
