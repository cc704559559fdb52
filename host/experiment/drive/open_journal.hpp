#pragma once

#include <filesystem>

#include "host/experiment/files/journal.hpp"
#include "host/recording/run.hpp"
#include "host/robot/client/client.hpp"

namespace astro::experiment {

/// What ends an experiment, or keeps it from going on.
enum class ExperimentProblem {
  other_settings,        // value: the experiment's folder
  other_robot,           // value: the experiment's folder
  recording_cut_off,     // value: the recording
  recording_unusable,    // value: the recording
  cannot_go_on,          // value: the recording that is missing or cannot be used
  other_factors_loaded,  // values: the phase, what the robot holds, and with what the phase began
  precision_unknown,
  truth_missing,    // value: what the source says
  broken_off,       // values: the experiment's folder, and the run
  parameters_kept,  // values: the folder of the phase's runs, and the calibration
  not_uploaded      // value: the experiment's folder
};

/// The end of a sentence about a recording that cannot be used.
std::string to_drive_again(const std::filesystem::path& recording);

/// The journal in `folder`, of an experiment that began there earlier; if there is none, one that begins now with this
/// plan and this robot, and is written.
///
/// Checks before anything moves what the experiment resumes from: each recording that is there, as require_usable does, and
/// that no recording of a finished phase is missing.
///
/// Throws astro::Error if the folder holds another plan or another robot's experiment, or if the experiment could not be
/// completed with one of its recordings, which it names then.
Journal open_journal(const std::filesystem::path& folder, const Plan& plan, const robot::Client& client);

/// Whether the next phase has begun, with other factors in the robot, so that no run of this one can be driven again.
bool is_over(const Journal& journal, std::size_t phase);

/// Throws astro::Error naming the recording if the experiment cannot be calibrated or reported on with it: it was cut off, is of
/// another run, robot or phase's factors, is a square of which an end is not known, or is the first drive and speaks against
/// the robot's wiring or sizes (first_drive.hpp). Ground truth that comes once a phase is
/// driven (ExperimentHooks::give_truth) may be missing.
void require_usable(const std::filesystem::path& folder, const Journal& journal, const RunSpec& spec,
                    const recording::Run& run);

}  // namespace astro::experiment
