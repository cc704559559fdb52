#pragma once

#include "host/console/command_line.hpp"

/// Between which drives the tracked body or a clock was set up anew.
namespace astro::commands {

/// --session-per-folder (folder_sessions.hpp). Without it sessions are found from the data.
void add_session_flag(console::Command command, bool& session_per_folder);

}  // namespace astro::commands
