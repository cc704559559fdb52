#pragma once

#include <filesystem>
#include <string>

#include "host/experiment/files/plan.hpp"

namespace astro::commands {

/// What a person with a tape measure reads before the first run: how many runs and readings are left in `folder`, how long
/// they take, and a drawing of where to put the tape. Lines of at most 80 columns.
std::string tape_briefing(const experiment::Plan& plan, const std::filesystem::path& folder);

}  // namespace astro::commands
