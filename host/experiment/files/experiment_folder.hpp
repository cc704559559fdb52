#pragma once

#include <filesystem>
#include <vector>

#include "host/experiment/files/plan.hpp"
#include "host/experiment/files/run_set.hpp"

/// Where the runs of an experiment are kept, and how far it has got.
namespace astro::experiment {

/// Squares of a phase that are recorded in both directions without a gap.
int recorded_squares(const std::filesystem::path& folder, const Plan& plan, std::size_t phase);

/// How many squares a phase has in each direction: those planned or, if it is open-ended, those recorded.
int squares_in_phase(const std::filesystem::path& folder, const Plan& plan, std::size_t phase);

/// Where a run of an experiment is kept.
std::filesystem::path file_of(const std::filesystem::path& folder, const RunSpec& spec);

/// Where a run's drive is kept until its truth comes afterwards; not listed as a recording.
std::filesystem::path file_without_truth(const std::filesystem::path& folder, const RunSpec& spec);

/// The first of these runs that is not recorded; null if all are.
const RunSpec* first_missing(const std::filesystem::path& folder, const std::vector<RunSpec>& specs);

/// The recordings of these runs, named as in the folder ("before/square-cw-3"). Throws what
/// recording::read_run throws.
RunSet read_specs(const std::filesystem::path& folder, const std::vector<RunSpec>& specs,
                  recording::Damage damage = recording::Damage::refused);

}  // namespace astro::experiment
