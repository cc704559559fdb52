#include "host/commands/shared/session_option.hpp"

namespace astro::commands {

void add_session_flag(console::Command command, bool& session_per_folder) {
  command.add_flag("--session-per-folder", session_per_folder,
                   "drives share the place of the tracked body and the\n"
                   "rate of the clocks within a folder, and only there\n"
                   "(default: as the drives themselves show)");
}

}  // namespace astro::commands
