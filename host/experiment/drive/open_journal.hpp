#pragma once

#include <filesystem>

#include "host/experiment/files/journal.hpp"
#include "host/recording/run.hpp"
#include "host/robot/client/client.hpp"

namespace astro::experiment {

/// What ends an experiment, or keeps it from going on. Values: its folder, or that of the runs of parameters_kept.
enum class ExperimentProblem {
  other_settings,
  other_robot,
  cannot_go_on,
  other_factors_loaded,
  precision_unknown,
  truth_missing,
  broken_off,
  parameters_kept,
  not_uploaded
};

/// The end of a sentence about a recording that cannot be used.
std::string to_drive_again(const std::filesystem::path& recording);

/// The journal in `folder`, of an experiment that began there earlier; if there is none, one that begins now with this
/// plan and this robot, and is written.
///
/// What the experiment goes on from is read and judged here, before anything moves: each recording that is there, as
/// require_usable does, and that none is missing of a phase that is over.
///
/// Throws astro::Error if the folder holds another plan or another robot's experiment, or naming the recording with which the
/// experiment could not come to its end.
Journal open_journal(const std::filesystem::path& folder, const Plan& plan, const robot::Client& client);

/// Whether the next phase has begun, with other factors in the robot, so that no run of this one can be driven again.
bool is_over(const Journal& journal, std::size_t phase);

/// Throws astro::Error naming the recording if the experiment cannot be calibrated or reported on with it: it was cut off, is of
/// another run, robot or phase's factors, or is a square of which an end is not known. Ground truth that comes once a phase is
/// driven (ExperimentHooks::give_truth) may be missing.
void require_usable(const std::filesystem::path& folder, const Journal& journal, const RunSpec& spec,
                    const recording::Run& run);

}  // namespace astro::experiment
