#pragma once

#include <filesystem>

#include "host/experiment/files/journal.hpp"
#include "host/robot/client/client.hpp"

namespace astro::experiment {

/// The journal in `folder`, of an experiment that began there earlier; if there is none, one that begins now with this
/// plan and this robot, and is written.
///
/// Throws astro::Error if the folder holds another plan or another robot's experiment.
Journal open_journal(const std::filesystem::path& folder, const Plan& plan, const robot::Client& client);

}  // namespace astro::experiment
